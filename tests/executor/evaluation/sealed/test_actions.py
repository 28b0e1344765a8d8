"""The process of the actions, without a judge: order of messages, and its end."""

from executor.evaluation.sealed.actions import place_of
from executor.evaluation.sealed.link import Fault
from executor.evaluation.sealed.run import Child

from executor.evaluation.sealed.link import Failed, LinkClosedError, Tick  # isort: skip

import pytest  # isort: skip

from tests.executor.tools.test_groups import unreaped  # isort: skip


def test_a_place_is_one_line():
    assert place_of(Fault("ValueError: no")) == "ValueError: no"
    assert (
        place_of(Fault("ValueError: no", "actions/A.py", 3, "go")) == "actions/A.py:3:1: go: ValueError: no"
    )


@pytest.mark.timeout(120)
def test_a_message_out_of_turn_ends_the_process(monkeypatch):
    was_its_own = unreaped(monkeypatch)
    child = Child()
    try:
        child.link.send(Tick(0.0, []))
        with pytest.raises(LinkClosedError):
            assert isinstance(child.link.receive_of_actions(), Failed)
        assert "ended by itself with status" in child.how_it_ended()
    finally:
        child.close()
    assert was_its_own == [True]
