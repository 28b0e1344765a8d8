"""Messages from outside: some change an exact run, the others do not."""

from __future__ import annotations

import pytest

from executor import child_messages, messages
from executor.child_messages import ForWorld
from executor.run_inputs import done_by, input_of, noted

CHANGE = [
    child_messages.SetTickRate(tick_hz=5.0),
    child_messages.SetBlackboard("", "k", 1),
    child_messages.SetPort(node_id="n", path="p", port="x", value=None),
    child_messages.SetBreakpoints(wanted=messages.SetBreakpoints([])),
    child_messages.Continue(),
    child_messages.ForceResult(force=messages.Force(2, "p")),
    child_messages.ReleaseForced(),
    child_messages.ApplyApplication(app_dir="/x"),
]
CHANGE_WORLD = [
    child_messages.Reset(),
    child_messages.StopRobot(),
    child_messages.Teleop(0.1, 0.2),
    child_messages.MoveBody(id="crate", pose=(0, 0, 0, 0, 0, 0)),
    child_messages.PublishTopic(topic="/x", message_type="std_msgs/msg/Empty", message={}),
]
DO_NOT = [
    child_messages.Pause(),
    child_messages.Resume(),
    child_messages.StepTick(),
    child_messages.ApplyApplication(app_dir="/x", dry=True),
    ForWorld(child_messages.Pause()),
    ForWorld(child_messages.SetSpeed(speed=2.0)),
    ForWorld(child_messages.StepWorld(dt_s=0.1)),
    ForWorld(child_messages.EchoTopic(topic="/x", max_hz=1.0)),
    ForWorld(child_messages.Subscribe("c", "poses")),
]


@pytest.mark.parametrize("message", CHANGE)
def test_commands_for_the_tree_change_a_run(message):
    assert input_of(message) is message


@pytest.mark.parametrize("command", CHANGE_WORLD)
def test_commands_for_the_world_change_a_run(command):
    assert input_of(ForWorld(command)) is command


@pytest.mark.parametrize("message", DO_NOT)
def test_pauses_speeds_and_views_do_not(message):
    assert input_of(message) is None


def test_every_command_of_the_protocol_for_a_child_is_decided():
    """A new message to a run must be put on one side."""
    told = set(child_messages.ToApplication.__args__) | set(child_messages.WorldCommand.__args__)
    decided = {type(message) for message in [*CHANGE, *CHANGE_WORLD]}
    others = {type(message.command if isinstance(message, ForWorld) else message) for message in DO_NOT}
    elsewhere = {
        child_messages.StartApplication,
        child_messages.Stop,
        child_messages.BeginRecording,
        child_messages.Control,  # of attached programs
        child_messages.MeasureNodes,
        child_messages.ServeGroot2,  # it only looks
        child_messages.ConnectDebugger,
        child_messages.TracePython,
        child_messages.Unsubscribe,
        child_messages.Pace,
        child_messages.ListTopics,
        child_messages.DescribeType,
        child_messages.ExpectNavigators,  # a session with a launch file is never exact
    }
    assert told == decided | others | elsewhere


def test_the_recording_says_what_was_done():
    assert noted(child_messages.Teleop(0.1, 0.2)) == {"linear": 0.1, "angular": 0.2}
    assert done_by(child_messages.SetTickRate(tick_hz=5.0, request="r1")) == {"tick_hz": 5.0}


@pytest.mark.parametrize("message", [*CHANGE, child_messages.Reset(), child_messages.StopRobot()])
def test_what_is_recorded_elsewhere_or_by_another_run_is_not_noted(message):
    assert noted(message) is None
