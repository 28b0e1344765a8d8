"""The lines between supervisor and worker."""

import json

import pytest

from executor.evaluation.outcome import Outcome
from executor.evaluation.pool.worker import Done, Job, Limits, read_done


def test_lines_are_read_as_they_were_written():
    done = Done(Outcome(3, "failure", "line\nfeed"), 1.5, 2.5, 1000)
    assert read_done(done.to_line()) == done
    assert done.to_line().count(b"\n") == 1
    assert json.loads(Job(3, Limits(30.0, 5)).to_line()) == {"seed": 3, "cpu_s": 30.0, "memory_bytes": 5}


def test_the_second_limit_is_real_time():
    assert Limits(30.0).wall_s == 300.0


@pytest.mark.parametrize("line", [b"", b"{}", b"[]", b'{"outcome": "{}"}'])
def test_other_lines_are_refused(line):
    with pytest.raises((ValueError, KeyError, AttributeError, TypeError)):
        read_done(line)
