"""Names of ROS: what the blocks take, what they refuse, and that the checker says the same."""

from __future__ import annotations

import pytest

from translator.check.port import is_ros_name as checker_takes
from tree_gardener import PortError
from tree_gardener.ros_nodes.names import checked_name, is_ros_name

NAMES = ("cmd_vel", "/cmd_vel", "/a/b2/_c", "~", "~/x", "local_costmap/clear", "_hidden")
OTHERS = ("", "/", "~/", "~x", "/a b", "9x", "/a/9", "/a//b", "/a/", "a-b", "a.b", "ä", "a\n", "{a}")


@pytest.mark.parametrize("name", NAMES)
def test_names(name: str) -> None:
    assert checked_name("topic_name", name) == name
    assert checker_takes(name)


@pytest.mark.parametrize("name", OTHERS)
def test_no_names(name: str) -> None:
    assert not is_ros_name(name)
    assert not checker_takes(name)
    with pytest.raises(PortError, match="is no name in ROS"):
        checked_name("topic_name", name)
