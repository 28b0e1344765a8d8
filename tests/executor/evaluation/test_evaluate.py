"""Estimates and progress; whole evaluations are run by `tests/backend/cli/evaluating/test_evaluate.py`."""

import os
import subprocess
import sys

import pytest

from executor.evaluation.evaluate import LIBRARIES, Progress, duration
from executor.evaluation.outcome import Outcome
from executor.supervision.single_threaded import SINGLE_THREADED
from tests.cli.typed import ROOT
from tests.executor.evaluation.projects import write


@pytest.mark.parametrize(
    ("seconds", "words"), [(3.4, "3 s"), (61, "1 min 1 s"), (3600, "1 h 0 min"), (7380, "2 h 3 min")]
)
def test_lengths_of_time(seconds, words):
    assert duration(seconds) == words


def test_what_is_said_of_an_evaluation_while_it_runs():
    progress = Progress(10, 2, {0: Outcome(0, "success"), 1: Outcome(1, "lost")}, [2.0, 3.0], 150_000_000)
    assert progress.line(sequential=False).startswith("2 of 10  success 100.0% (20.7% to 100.0%)  ")
    assert progress.estimate().startswith(
        "a run takes about 2.0 s of a processor and 150 MB of memory; the other 8"
    )
    assert Progress(10, 2).left_s == 0
    summary = progress.summary(range(10), sequential=False)
    assert (summary.counted, summary.wanted, summary.stopped_early) == (1, 10, False)


LOADED = """
import os, sys
from pathlib import Path
from executor.evaluation.evaluate import load_libraries
from executor.evaluation.plan import make_plan
from executor.evaluation.run import run_cell
from translator import open_path
plan = make_plan(open_path(Path(sys.argv[1])), "main")
load_libraries()
before = set(sys.modules)
run_cell(plan, 0)
print(*sorted(set(sys.modules) - before))
"""


@pytest.mark.simulation
def test_the_parent_loads_what_every_run_imports(tmp_path):
    assert "executor.evaluation.run" in LIBRARIES
    text = "duration_s: 0.5\nruns: 1\njudge: {success: [{never: collision}]}\n"
    folder = write(tmp_path / "p", text)
    environment = {**os.environ, **SINGLE_THREADED, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-c", LOADED, str(folder)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    late = [name for name in done.stdout.split() if not name.startswith(("actions", "_cython"))]
    assert late == []
