"""Runs the corpus on the engine that the interpreter finds: `python -I corpus.py MOST FILE…`.

MOST is how many cases of each file are run. The test of the wheel runs this file by its path in environments
of several Pythons, which have neither pytest nor the package `tests`. It prints one JSON object.
"""

from __future__ import annotations

import gzip
import importlib.util
import itertools
import json
import logging
import sys
from pathlib import Path
from typing import Any

import tree_gardener
from tree_gardener.conformance import run_case, run_file

# Its cases have control nodes that are programs.
CONTRACT = "contract.jsonl.gz"
FOREIGN = ("django", "rclpy", "lxml", "translator", "executor", "backend", "tests", "zmq", "msgpack")


def main(most: int, paths: list[Path]) -> dict[str, Any]:
    """Returns how many cases of each file ran, what failed, and what was loaded that should not be."""
    logging.disable()  # the corpus has control nodes that leave children running on purpose
    counts: dict[str, int] = {}
    failed: list[str] = []
    for path in paths:
        counts[path.name] = 0
        outcomes = _contract(path) if path.name == CONTRACT else run_file(path)
        for outcome in itertools.islice(outcomes, most):
            counts[path.name] += 1
            if outcome.failed:
                failed.append(f"{path.name} {outcome.name}: {outcome.differences[:1]}")
    return {
        "python": ".".join(map(str, sys.version_info[:2])),
        "engine": str(Path(tree_gardener.__file__).parent),
        "counts": counts,
        "failed": failed,
        "foreign": sorted(set(FOREIGN) & {name.partition(".")[0] for name in sys.modules}),
    }


def _contract(path: Path) -> Any:
    spec = importlib.util.spec_from_file_location("programmed", Path(__file__).with_name("programmed.py"))
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for line in gzip.decompress(path.read_bytes()).splitlines():
        yield run_case(json.loads(line), module.programmed)


if __name__ == "__main__":
    json.dump(main(int(sys.argv[1]), [Path(word) for word in sys.argv[2:]]), sys.stdout)
