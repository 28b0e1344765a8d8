"""Reports what `make test` would run: `python -m tests.tools.selection [--replay N]`.

Without an option: of the working tree, test by test. `--replay 200` prints for each of the last 200 commits
which dear tests its paths touch in today's tree, and the processor minutes of its `make test`, with the
digests
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from functools import reduce
from operator import or_
from pathlib import Path

from tests.tools.selection import tree
from tests.tools.selection.choose import choose, core_of, core_patterns
from tests.tools.selection.inputs import Inputs, import_graph
from tests.tools.selection.replay import Change, Replay, change_of, commits, is_product, summary
from tests.tools.selection.shards import ShardError, collect
from tests.tools.selection.table import ROOT, Table, TableError, read, read_executed, read_loaded


def main(arguments: list[str]) -> int:
    """Prints a selection; returns 2 where there is none."""
    parser = argparse.ArgumentParser(prog="python -m tests.tools.selection")
    parser.add_argument("--replay", type=int, default=0, metavar="N")
    parser.add_argument("--age", type=int, default=20, metavar="COMMITS")
    parser.add_argument("--sample", default="")
    parser.add_argument("--collect", type=Path, nargs="+", metavar="FOLDER")
    options = parser.parse_args(arguments)
    try:
        files = tree.working_tree()
        if options.collect:
            return collect(options.collect, files)
        table = read()
        inputs = Inputs(files, import_graph(), read_loaded(), executed=read_executed())
        if options.replay:
            return _replay(table, inputs, options.replay, options.age)
        return _show(table, inputs, options.sample or tree.digest(files))
    except (TableError, ShardError) as error:
        print(f"selection: {error}", file=sys.stderr)
        return 2
    except subprocess.CalledProcessError as error:
        print(
            f"selection: git: {str(error.stderr).strip()}; a replay needs a checkout with its history",
            file=sys.stderr,
        )
        return 2


def _show(table: Table, inputs: Inputs, sample: str) -> int:
    selection = choose(
        table, core_of(core_patterns()), lambda file: table.inputs.get(file) != inputs.digest(file), sample
    )
    for test, reason in selection.reasons.items():
        print(f"{reason:9} {table.tests[test].median_s:6.1f} s  {test}")
    print(f"SAMPLE={sample}")
    return 0


def _replay(table: Table, inputs: Inputs, number: int, age: int) -> int:
    replay = Replay(table, inputs, core_of(core_patterns()))
    history = commits(ROOT, number + age)
    changes = [change_of(ROOT, commit) for commit, _ in history]
    minutes: list[float] = []
    for index, (commit, subject) in enumerate(history[:number]):
        change = reduce(or_, changes[index : index + age], Change(frozenset()))
        selection = replay.of(change, commit)
        cost = replay.minutes(selection)
        mark = "product" if is_product(changes[index].paths) else "other"
        if mark == "product":
            minutes.append(cost)
        print(f"{commit[:8]} {cost:6.1f} min {mark:7} {replay.counts(selection)}  {subject[:60]}")
    print(summary(minutes, replay.all_minutes))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
