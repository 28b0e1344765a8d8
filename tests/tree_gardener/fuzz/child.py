"""Runs a batch of cases in BehaviorTree.CPP, in a process of its own because it can crash.

Reads pickled cases from stdin; writes one JSON line a case, so that the last line names the case.
"""

from __future__ import annotations

import json
import os
import pickle
import signal
import sys

from tests.tree_gardener.fuzz.reference import run_reference

ENDLESS_S = 2


def main() -> None:
    # behaviortreepy prints what it catches; our lines go through a copy of stdout.
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    for case in pickle.load(sys.stdin.buffer):  # noqa: S301 - our own parent wrote it
        # Some trees never end in tickOnce: two nodes that yield under a reactive node wake each other
        # forever.
        signal.alarm(ENDLESS_S)
        out.write(json.dumps(run_reference(case)) + "\n")
        out.flush()


if __name__ == "__main__":
    main()
