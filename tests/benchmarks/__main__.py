"""`make bench`: every benchmark in one run, so that ratios come from one machine at one time.

With `--beside REVISION` the benchmarks named are run in turn in this tree and in that revision.
"""

from __future__ import annotations

import importlib
import itertools
import os
import platform
import sys

from tests.benchmarks.beside.command import main as beside
from tests.benchmarks.beside.command import parser

BENCHMARKS = (
    "engine",
    "distribution",
    "debugger",
    "python_debugger",
    "stops",
    "debugger_page",
    "groot",
    "attached",
    "translator",
    "behaviours",
    "difference",
    "world",
    "evaluation",
    "stream",
    "session",
    "exact",
    "recording",
    "flood",
    "known_sessions",
    "two_servers",
    "opening",
    "browser",
    "whole",
    "evaluate_panel",
    "axis",
    "marks",
    "capacity",
)


ALONE = ("ends", "hangs", "heap", "imported", "load", "save_cost", "saves", "soak", "tasks")
"""Those that take so long, or need so much, that they are only run by name."""


def main(arguments: list[str]) -> int:
    """Runs the benchmarks named, or all; what stands after the names are options."""
    names = list(itertools.takewhile(lambda word: not word.startswith("-"), arguments))
    rest = arguments[len(names) :]
    is_beside = any(word.partition("=")[0] == "--beside" for word in rest)
    options, own = parser().parse_known_args(rest) if is_beside else (None, rest)
    unknown = [name for name in names if name not in (*BENCHMARKS, *ALONE)]
    if unknown or (options and not names and not options.clean):
        what = f"There is no benchmark {unknown[0]!r}" if unknown else "Name what to compare"
        print(f"{what}; there are {', '.join(BENCHMARKS)}, and alone {', '.join(ALONE)}.", file=sys.stderr)
        return 2
    if options:
        return beside(names, options, own)
    print(f"{platform.machine()}, {os.cpu_count()} cores, CPython {platform.python_version()}\n")
    for name in names or BENCHMARKS:
        print(f"== {name} " + "=" * (70 - len(name)), flush=True)
        sys.argv = [name, *own]
        importlib.import_module(f"tests.benchmarks.{name}").main()
        print()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
