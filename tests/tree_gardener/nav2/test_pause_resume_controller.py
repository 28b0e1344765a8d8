"""PauseResumeController of Nav2."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from std_srvs.srv import Trigger

from tree_gardener import Status
from tree_gardener.controls.custom import CustomControl
from tree_gardener.nav2.pause_resume_controller import PauseResumeController, State

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

WAIT = "<Sleep name='{0}' msec='1000'/>"
NAMES = "pause_service_name='pause' resume_service_name='resume'"


def loaded(ros: Graph, *children: str) -> Any:
    ros.load(f"<PauseResumeController {NAMES}>{''.join(children)}</PauseResumeController>")
    (node,) = ros.tree.nodes[:1]
    assert isinstance(node, CustomControl)
    return node.instance_behaviour


def asked(ros: Graph, name: str) -> Any:
    client = ros.other.create_client(Trigger, name)
    ros.spin(client.service_is_ready)
    answer = client.call_async(Trigger.Request())
    ros.spin(answer.done)
    ros.other.destroy_client(client)
    return answer.result()


def test_paused_it_ticks_the_second_child_and_the_others_at_the_changes(ros: Graph) -> None:
    done = "<Script code='{0} := true'/>"
    changes = done.format("on_pause"), done.format("on_resume")
    node = loaded(ros, WAIT.format("work"), WAIT.format("stand"), *changes)
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    assert asked(ros, "pause").success
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    assert (node.state, ros["on_pause"]) == (State.PAUSED, True)
    assert ros.tree.nodes[1].status is Status.IDLE
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    assert ros.tree.nodes[2].status is Status.RUNNING
    assert asked(ros, "resume").success
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    assert (node.state, ros["on_resume"]) == (State.RESUMED, True)
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(1.1)
    assert ros.tree.tick_exactly_once() is Status.SUCCESS


def test_with_one_child_the_changes_take_a_tick_each(ros: Graph) -> None:
    node = loaded(ros, WAIT.format("work"))
    ros.tree.tick_exactly_once()
    asked(ros, "pause")
    states = []
    for _ in range(3):
        assert ros.tree.tick_exactly_once() is Status.RUNNING
        states.append(node.state)
    assert states == [State.PAUSED] * 3


@pytest.mark.parametrize("name", ["pause", "resume"])
def test_a_request_that_makes_no_sense_is_refused(ros: Graph, name: str) -> None:
    node = loaded(ros, WAIT.format("work"))
    ros.tree.tick_exactly_once()
    if name == "pause":
        asked(ros, "pause")
        ros.tree.tick_exactly_once()
    answer = asked(ros, name)
    assert not answer.success
    assert "state PAUSED" in answer.message
    assert node.state in {State.RESUMED, State.PAUSED}


def test_a_child_that_fails_fails_it_and_a_halt_resumes_it(ros: Graph) -> None:
    node = loaded(ros, WAIT.format("work"), WAIT.format("stand"), "<AlwaysFailure/>")
    ros.tree.tick_exactly_once()
    asked(ros, "pause")
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert node.state is State.RESUMED
    ros.tree.tick_exactly_once()
    asked(ros, "pause")
    ros.tree.halt()
    assert node.state is State.RESUMED


def test_without_ros_it_ticks_its_first_child() -> None:
    node = PauseResumeController("x")
    node.setup()
    assert node.services == []
    node.shutdown()
