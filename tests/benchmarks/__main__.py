"""`make bench`: every benchmark in one run, so that ratios come from one machine at one time."""

from __future__ import annotations

import importlib
import os
import platform
import sys

BENCHMARKS = (
    "engine",
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
    "evaluate_panel",
    "axis",
    "marks",
    "capacity",
)


def main(names: list[str]) -> None:
    """Runs the benchmarks named, or all."""
    print(f"{platform.machine()}, {os.cpu_count()} cores, CPython {platform.python_version()}\n")
    for name in names or BENCHMARKS:
        print(f"== {name} " + "=" * (70 - len(name)), flush=True)
        importlib.import_module(f"tests.benchmarks.{name}").main()
        print()


if __name__ == "__main__":
    main(sys.argv[1:])
