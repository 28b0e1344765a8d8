"""The world of an attached session confirms, and simulates nothing."""

from __future__ import annotations

from executor import child_messages
from executor.attached.world import answer


def test_it_is_ready_at_once_and_confirms() -> None:
    assert [type(each) for each in answer(child_messages.StartWorld("none"))] == [
        child_messages.Starting,
        child_messages.WorldReady,
    ]
    assert answer(child_messages.Resume(request="r")) == [child_messages.Answer(request="r")]
    [refused] = answer(child_messages.Reset(request="r"))
    assert isinstance(refused, child_messages.Answer)
    assert refused.error is not None
    assert refused.error.code == "attached"
    assert answer(child_messages.StopRobot()) == []
