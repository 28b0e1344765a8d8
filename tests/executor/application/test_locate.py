"""Stack frames, nodes and lines of actions."""

from __future__ import annotations

import sys
from typing import Any

from executor.application.locate import Locator, Place, is_action_file
from tests.tree_gardener.trees import load

SOURCE = """
def look(self, frame_of):
    return frame_of()
"""


def test_a_frame_of_an_action_has_its_node_and_line() -> None:
    tree = load("<Succeeding name='a' _bts_id='n7'/>")
    locator = Locator()
    locator.learn(tree)
    names: dict[str, Any] = {}
    exec(compile(SOURCE, "actions/Go.py", "exec"), names)  # noqa: S102 - as the engine loads an action
    frame = names["look"](tree.nodes[0].behaviour, lambda: sys._getframe(1))
    place = locator.place_of(frame)
    assert (place.node_id, place.file, place.line, place.is_in_action) == ("n7", "actions/Go.py", 3, True)
    assert str(place) == "Succeeding 'a' (actions/Go.py:3)"
    assert place.to_message() is not None


def test_a_frame_of_ours_is_in_no_action() -> None:
    place = Locator().place_of(sys._getframe())
    assert place == Place()
    assert place.to_message() is None
    assert is_action_file("actions/Go.py")
    assert not is_action_file("/opt/actions/Go.py")
