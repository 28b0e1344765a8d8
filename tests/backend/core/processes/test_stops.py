"""Work that is ended from another thread, before or while it runs."""

from __future__ import annotations

import pytest

from backend.core.processes.stops import Stop, StoppedError


def test_work_is_ended_before_or_while_it_runs_but_not_after_it():
    ends = []
    stop = Stop()
    stop.bind(lambda: ends.append("first"))
    stop.set()
    assert ends == ["first"]
    with pytest.raises(StoppedError):
        stop.bind(lambda: ends.append("second"))
    stop.release()
    stop.set()
    assert ends == ["first"]
