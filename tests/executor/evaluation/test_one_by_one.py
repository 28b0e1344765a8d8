"""The process of `cells` stays in step with the tests that share it."""

import signal
import sys

import pytest

from tests.executor.evaluation.one_by_one import Cells

ANSWERS = """
import json, sys, time
for line in sys.stdin:
    job = json.loads(line)
    if job.get("ends"):
        sys.exit(3)
    if job.get("hangs"):
        time.sleep(600)  # the run that the time limit of a test ends
    print(json.dumps({"seed": job["seed"], "outcome": "success"}), flush=True)
"""
HANGS = (sys.executable, "-c", ANSWERS)


class TooLateError(Exception):
    """A time limit, in the middle of a question."""


@pytest.fixture
def cells():
    with Cells(command=HANGS) as found:
        yield found


@pytest.fixture
def limit():
    def late(*_):
        raise TooLateError

    before = signal.signal(signal.SIGALRM, late)
    yield lambda seconds: signal.setitimer(signal.ITIMER_REAL, seconds)
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


def test_a_question_after_an_interrupted_one_gets_its_own_answer(cells, limit, tmp_path):
    assert cells(tmp_path, seed=1).seed == 1
    limit(0.2)
    with pytest.raises(TooLateError):
        cells(tmp_path, seed=2, hangs=True)
    assert cells(tmp_path, seed=3).seed == 3


def test_a_question_after_the_end_of_the_process_gets_an_answer(cells, tmp_path):
    with pytest.raises(AssertionError, match="the run has ended its process"):
        cells(tmp_path, seed=1, ends=True)
    assert cells(tmp_path, seed=2).seed == 2


def test_an_interrupted_question_does_not_delay_the_end(limit, tmp_path):
    with Cells(command=HANGS) as cells:
        limit(0.2)
        with pytest.raises(TooLateError):
            cells(tmp_path, hangs=True)
