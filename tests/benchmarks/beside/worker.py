"""Runs one benchmark and writes its figures: `worker.py own|whole FILE NAME [options]`.

`own` lets a benchmark yield its own figures where it has any; `whole` only runs its `main()`. It is run in
both trees, each with its own environment, so it imports nothing of the product itself.
"""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path


def main(arguments: list[str]) -> None:
    """Writes a line for each figure."""
    kind, path, name, *options = arguments
    module = importlib.import_module(f"tests.benchmarks.{name}")
    sys.argv = [name, *options]
    measure = getattr(module, "measure", None) if kind == "own" else None
    if measure is None:
        module.main()
        return
    with Path(path).open("a", encoding="utf-8") as lines:
        for figure in measure(options):
            print(figure, flush=True)
            lines.write(json.dumps(figure.to_json()) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
