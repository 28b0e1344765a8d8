"""Estimates and progress; whole evaluations are run by `tests/backend/cli/evaluating/test_evaluate.py`."""

import pytest

from executor.evaluation.evaluate import LIBRARIES, Progress, duration
from executor.evaluation.outcome import Outcome


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


def test_the_parent_loads_what_every_run_imports():
    assert "executor.evaluation.run" in LIBRARIES
