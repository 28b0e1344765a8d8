"""Parameters of another node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from rcl_interfaces.msg import ParameterDescriptor

from tree_gardener import Status, TickError
from tree_gardener.ros_nodes.parameter import RosParam

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")


def param(name: str, ports: str) -> str:
    return f"<RosParam node_name='other' param_name='{name}' {ports}/>"


@pytest.mark.parametrize("value", [True, 3, 0.5, "map", [1.0, 2.0]])
def test_a_parameter_is_read(ros: Graph, value: Any) -> None:
    ros.other.declare_parameter("p", value)
    assert ros.run(param("p", "value='{v}'")) is Status.SUCCESS
    assert ros["v"] == value
    assert RosParam.__name__ == "RosParam"


@pytest.mark.parametrize(("text", "value"), [("true", True), ("7", 7), ("0.75", 0.75), ("odom", "odom")])
def test_a_parameter_is_set(ros: Graph, text: str, value: Any) -> None:
    ros.other.declare_parameter("p", type(value)())
    assert ros.run(param("p", f"set='{text}'")) is Status.SUCCESS
    assert ros.other.get_parameter("p").value == value


def test_a_refusal_gives_the_reason(ros: Graph) -> None:
    ros.other.declare_parameter("p", 1.0, ParameterDescriptor(read_only=True))
    assert ros.run(param("p", "set='2.0' error='{why}'")) is Status.FAILURE
    assert "read-only" in ros["why"]


def test_a_parameter_that_nobody_declared_fails(ros: Graph) -> None:
    assert ros.run(param("p", "value='{v}' error='{why}'")) is Status.FAILURE
    assert ros["why"] == "PARAMETER_NOT_DECLARED"


def test_a_wrong_name_of_a_node_is_explained(ros: Graph) -> None:
    with pytest.raises(TickError, match="port 'node_name': 'o ther' is no name in ROS"):
        ros.run(param("p", "value='{v}'").replace("other", "o ther"))


def test_a_missing_node_fails(ros: Graph) -> None:
    ros.load(param("p", "error='{why}'").replace("other", "nobody"))
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(1.0)
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert ros["why"] == "SERVICE_UNREACHABLE"
