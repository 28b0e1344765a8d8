"""The editor's templates of new actions are read by the translator, and run."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest
import rclpy.action

from tests.fakes.ros_clients import NAV2, Handle, Node
from tests.tree_gardener.trees import load
from translator.action import inspect_action
from tree_gardener import ManualClock, Status, Tree
from tree_gardener.actions import load_actions

TEMPLATES = Path(__file__).parents[2] / "frontend" / "src" / "features" / "code" / "templates"
SUCCEEDED, ABORTED = 4, 6  # action_msgs/msg/GoalStatus


def source_of(template: str) -> str:
    return (TEMPLATES / f"{template}.py").read_text(encoding="utf-8").replace("NewAction", "Mine")


@pytest.mark.parametrize("path", sorted(TEMPLATES.glob("*.py")), ids=lambda path: path.stem)
def test_each_declares_typed_ports_and_says_what_it_is(path: Path) -> None:
    model = inspect_action(source_of(path.stem), "Mine.py")
    assert model.diagnostics == ()
    assert (model.name, model.open) == ("Mine", False)
    named_after_their_kind = {"condition", "control", "decorator"}
    assert model.kind == (path.stem if path.stem in named_after_their_kind else "action")
    assert model.ports
    assert all(port.type in {"double", "int", "string"} and port.description for port in model.ports)


def test_a_control_node_tries_its_children_up_to_the_limit() -> None:
    nodes = dict(load_actions({"Mine": source_of("control")}))
    body = "<Failing/><Failing/><Succeeding/>"
    for limit, expected in ((3, Status.SUCCESS), (2, Status.FAILURE)):
        assert load(f'<Mine limit="{limit}">{body}</Mine>', nodes=nodes).tick_once() is expected
    assert load("<Mine><Failing/><Running/></Mine>", nodes=nodes).tick_once() is Status.RUNNING


def test_a_decorator_ticks_its_child_at_its_period() -> None:
    clock = ManualClock()
    nodes = dict(load_actions({"Mine": source_of("decorator")}))
    tree = load('<Mine period_s="0.5"><Succeeding/></Mine>', nodes=nodes, clock=clock)
    found = []
    for _ in range(4):
        found.append(tree.tick_once())
        clock.advance(0.3)
    assert found == [Status.SUCCESS, Status.SKIPPED, Status.SUCCESS, Status.SKIPPED]


def tree_of(template: str, attributes: str, node: Node) -> Tree:
    tree = load(f"<Mine {attributes}/>", nodes=dict(load_actions({"Mine": source_of(template)})))
    tree.setup(node)
    return tree


@pytest.mark.parametrize(("success", "expected"), [(True, Status.SUCCESS), (False, Status.FAILURE)])
def test_a_service_is_called_and_its_answer_kept(success: bool, expected: Status) -> None:
    from std_srvs.srv import Trigger

    node = Node()
    tree = tree_of("service", 'service="/open" answer="{said}"', node)
    assert tree.tick_once() is Status.RUNNING
    [client] = node.clients
    assert client.about == (Trigger, "/open")
    assert client.sent == [], "nobody is there yet"
    client.is_ready = True
    assert [tree.tick_once(), tree.tick_once()] == [Status.RUNNING] * 2
    assert len(client.sent) == 1
    client.answers[0].set_result(Trigger.Response(success=success, message="well"))
    assert tree.tick_once() is expected
    assert tree.blackboard["said"] == "well"
    assert tree.tick_once() is Status.RUNNING
    assert len(client.sent) == 2, "it can be called again, by the same client"
    tree.halt()
    assert client.answers[1].cancelled()


@pytest.fixture
def nav2(monkeypatch: pytest.MonkeyPatch) -> Node:
    node = Node()
    for name, module in NAV2.items():
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.setattr(rclpy.action, "ActionClient", node.create_action_client)
    return node


def sent(node: Node) -> tuple[Tree, Any]:
    tree = tree_of("goal", 'x="1.5" y="-2"', node)
    [client] = node.clients
    assert tree.tick_once() is Status.RUNNING
    client.is_ready = True
    assert tree.tick_once() is Status.RUNNING
    [goal] = client.sent
    assert (goal.pose.pose.position.x, goal.pose.pose.position.y) == (1.5, -2.0)
    return tree, client


@pytest.mark.parametrize(("status", "expected"), [(SUCCEEDED, Status.SUCCESS), (ABORTED, Status.FAILURE)])
def test_a_goal_is_sent_and_its_end_waited_for(nav2: Node, status: int, expected: Status) -> None:
    from action_msgs.msg import GoalStatus

    tree, client = sent(nav2)
    handle = Handle(accepted=True)
    client.answers[0].set_result(handle)
    assert [tree.tick_once(), tree.tick_once()] == [Status.RUNNING] * 2
    handle.result.set_result(type("Answer", (), {"status": status}))
    assert tree.tick_once() is expected
    assert (GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_ABORTED) == (SUCCEEDED, ABORTED)
    assert handle.cancelled == 0


def test_a_goal_that_is_refused_fails(nav2: Node) -> None:
    tree, client = sent(nav2)
    client.answers[0].set_result(Handle(accepted=False))
    assert tree.tick_once() is Status.FAILURE


@pytest.mark.parametrize("is_answered", [True, False])
def test_a_goal_is_cancelled_with_its_block(nav2: Node, is_answered: bool) -> None:
    tree, client = sent(nav2)
    handle = Handle(accepted=True)
    if is_answered:
        client.answers[0].set_result(handle)
        assert tree.tick_once() is Status.RUNNING
    tree.halt()
    if not is_answered:
        client.answers[0].set_result(handle)
    assert handle.cancelled == 1
