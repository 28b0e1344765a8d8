"""`make test` and `make test-full`: lint, the page's tests and Python's beside each other.

    python -m tests.tools.suite [--full] [--shard 3/8] [--counts full|test] [-- arguments of pytest]

`make test` runs all tests that are not dear, the core (`tests/core.toml`), each dear test whose inputs
changed since the last green full run, and a tenth of the other dear ones; `SAMPLE=` repeats that draw.
`--full` runs all, measured; when all shards of one tree came to their ends, the table `tests/durations.json`
is written. Each line is shown as it comes, with the name of its lane; failures are listed again at the end.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from tests.tools.lanes import PASSED, TESTS_FAILED, Lane
from tests.tools.measuring.install import noting
from tests.tools.measuring.results import measured
from tests.tools.selection import plugin, tree
from tests.tools.selection.choose import Reason, Selection, choose, core_of, core_patterns
from tests.tools.selection.inputs import Inputs, import_graph
from tests.tools.selection.shards import Shard, ShardError, share, store
from tests.tools.selection.table import (
    ROOT,
    Executed,
    Table,
    TableError,
    read,
    read_executed,
    read_loaded,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

# Browser tests, waiting ones, and two workers beside them: a half of all tests waits for processes.
WORKERS: Final = 4
FRONTEND: Final = ROOT / "frontend"
BIN: Final = Path(sys.executable).parent


def main(arguments: list[str]) -> int:
    """Runs the suite; returns 0 if all passed, 130 after Ctrl+C."""
    options, rest = _options(arguments)
    try:
        shard = Shard.parse(options.shard)
        files = tree.working_tree()
        table = _table(is_needed=not options.full)
        if options.full:
            return _full(shard, table, files, options.counts, rest)
        known = Known(read_loaded() if table.tests else {}, read_executed())
    except (TableError, ShardError) as error:
        print(f"tests: {error}", file=sys.stderr)
        return 2

    def chosen() -> Lane:
        selection = select(table, files, known, os.environ.get("SAMPLE", ""))
        for line in described(selection, table):
            print(line, flush=True)
        file = ROOT / "var" / "selection.json"
        selection.save(file)
        return python(rest, {plugin.VARIABLE: str(file)})

    return run([*lint(), *page(Shard(1, 1))], chosen)


class Known(NamedTuple):
    """The notes of earlier runs about the files of tests."""

    loaded: Mapping[str, frozenset[str]]
    executed: Mapping[str, Executed]


def select(table: Table, files: dict[str, str], known: Known, sample: str) -> Selection:
    """Chooses the tests of the working tree."""
    inputs = Inputs(files, import_graph(), known.loaded, executed=known.executed)
    return choose(
        table,
        core_of(core_patterns()),
        lambda file: table.inputs.get(file) != inputs.digest(file),
        sample or tree.digest(files),
    )


def described(selection: Selection, table: Table) -> Iterator[str]:
    """Returns lines that name what runs, and why."""
    dear = table.dear()
    for reason in Reason:
        tests = selection.tests(reason)
        minutes = sum(dear[test] for test in tests) / 60
        yield f"tests  | {len(tests)} dear tests, {minutes:.1f} processor minutes: {reason}"
    yield f"tests  | SAMPLE={selection.sample} repeats the draw; `make test-full` runs all"


def _full(shard: Shard, table: Table, files: dict[str, str], counts: str, rest: list[str]) -> int:
    folder = ROOT / "var" / "full" / tree.digest(files) / shard.name
    environment = {"BT_STUDIO_MEASURE": str(folder), "BT_STUDIO_FULL": "1" if counts == "full" else ""}
    chosen = share(table, files, shard)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "files").write_text("\n".join(chosen), encoding="utf-8")
    environment[plugin.SHARD_VARIABLE] = str(folder / "files")
    for name in ("runs", "loaded", "executed"):
        for old in (folder / name).glob("*"):
            old.unlink()
    own = lint() if shard.number == 1 else []
    lanes = [*own, *page(shard), python(["--timeout", "0", *rest], environment)]
    with noting(folder, files):
        result = run(lanes)
    seconds = {lane.name: lane.processor_s for lane in lanes if lane is not lanes[-1]}
    is_complete = result in (PASSED, TESTS_FAILED)
    return store(measured(folder, files), seconds, table, files, shard, is_complete=is_complete) or result


def run(lanes: list[Lane], later: Callable[[], Lane] | None = None) -> int:
    """Runs lanes beside each other to their ends, and lists what failed.

    Args:
        lanes: those that start at once.
        later: makes another one while these run, since choosing its tests takes a while.
    """
    began_s = time.monotonic()
    try:
        for lane in lanes:
            lane.start()
        if later is not None:
            last = later()
            last.start()
            lanes = [*lanes, last]
        for lane in lanes:
            lane.join()
    except KeyboardInterrupt:  # all that they run was interrupted too, and prints its summary
        for lane in lanes:
            lane.join()
        return 130
    for lane in lanes:
        print("".join(f"{lane.name:7}| {line}" for line in lane.summary), end="")
    minutes = sum(lane.processor_s for lane in lanes) / 60
    print(
        ", ".join(map(str, lanes)),
        f"in {(time.monotonic() - began_s) / 60:.1f} min, {minutes:.1f} of processors",
    )
    failed = [lane.result for lane in lanes if lane.result != PASSED]
    return max(failed, key=lambda result: result not in (PASSED, TESTS_FAILED), default=PASSED)


def lint() -> list[Lane]:
    """Returns the lanes of style, types and directions of imports.

    They wait for nothing, and take what the tests leave of the processors.
    """
    make = ["nice", "-n", "19", "make", "--no-print-directory"]
    return [Lane("lint", [*make, "lint-python"], ROOT), Lane("eslint", [*make, "lint-frontend"], ROOT)]


def page(shard: Shard) -> list[Lane]:
    """Returns the lane of the page's tests."""
    vitest = ["npx", "vitest", "run"]
    if shard.of > 1:
        vitest.append(f"--shard={shard.number}/{shard.of}")
    return [Lane("page", vitest, FRONTEND), Lane("size", ["npm", "run", "--silent", "size"], FRONTEND)]


def python(arguments: list[str], environment: dict[str, str]) -> Lane:
    """Returns the lane of pytest."""
    plugins = ("-p", "tests.tools.selection.plugin", "-p", "tests.tools.measuring.plugin")
    workers = ("-n", str(WORKERS), "--dist", "loadfile", "--durations", "25", "--durations-min", "5")
    return Lane("python", [sys.executable, "-m", "pytest", *plugins, *workers, *arguments], ROOT, environment)


def _table(*, is_needed: bool) -> Table:
    try:
        return read()
    except TableError:
        if is_needed:
            raise
        return Table()


def _options(arguments: list[str]) -> tuple[argparse.Namespace, list[str]]:
    parser = argparse.ArgumentParser(
        prog="python -m tests.tools.suite", description=__doc__.partition("\n")[0]
    )
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--shard", default=os.environ.get("SHARD") or "1/1")
    parser.add_argument("--counts", choices=("full", "test"), default=os.environ.get("COUNTS") or "full")
    return parser.parse_known_args(arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
