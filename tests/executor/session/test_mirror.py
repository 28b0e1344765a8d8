"""The state that a late client gets."""

from __future__ import annotations

from msgspec import structs

from executor.messages import (
    Blackboard,
    BlackboardEntry,
    Fault,
    Finished,
    FlagSet,
    Held,
    HeldInPython,
    LaunchNode,
    LaunchNodes,
    Log,
    PortSet,
    RecordingStopped,
    Segment,
    StateChanged,
    Tick,
    TopicMismatch,
    Tree,
    TreeNode,
)
from executor.session.ladder import State
from executor.session.mirror import FAULTS, LOG_LINES, STOPS, Mirror

NODE = TreeNode(uid=1, parent=0, type="A", kind="action", name="", path="A::1", node_id="", tree_id="T")


def entry(key: str, value: object, *, removed: bool = False) -> Blackboard:
    return Blackboard([BlackboardEntry("", key, "int", value, False, removed)])


def test_events_add_up_to_the_snapshot() -> None:
    mirror = Mirror()
    mirror.begin_run(20.0)
    for event in (
        StateChanged(State.PAUSED.value),
        Tree([NODE]),
        Tick(n=1, changed=[(1, "RUNNING")], flashed=[], duration_ms=2.0),
        entry("a", 1),
        entry("b", 2),
        entry("a", None, removed=True),
    ):
        mirror.apply(event)
    snapshot = mirror.snapshot()
    assert (snapshot.state, snapshot.statuses) == (State.PAUSED.value, [(1, "RUNNING")])
    assert [item.key for item in snapshot.blackboard] == ["b"]
    assert mirror.tick_load() == (2.0, 50.0)


def test_flags_are_those_of_the_present_run_and_stops_are_bounded() -> None:
    mirror = Mirror()
    for flag in (FlagSet("a", "1", 1.0, "one"), FlagSet("a", "2", 2.0, "two"), FlagSet("a", "1", 1.0, "")):
        mirror.apply(flag)
    assert [flag.text for flag in mirror.snapshot().flags] == ["two"]
    mirror.apply(FlagSet("b", "3", 0.0, "three"))
    assert [flag.text for flag in mirror.snapshot().flags] == ["three"]
    for at in range(STOPS + 5):
        mirror.apply(RecordingStopped("a", float(at), "recorder_died", "was killed", goes_on=True))
    assert [stop.t for stop in mirror.snapshot().stops] == [float(at + 5) for at in range(STOPS)]
    mirror.apply(Segment("b", 0, 0, 0, 0.0, 1.0, 10))
    assert mirror.snapshot().stops == []


def test_a_new_run_begins_empty_and_faults_are_bounded() -> None:
    mirror = Mirror()
    for number in range(FAULTS + 5):
        mirror.apply(Fault("process", str(number)))
    assert len(mirror.snapshot().faults) == FAULTS
    mirror.begin_run(10.0)
    assert mirror.snapshot().faults == []


def test_the_last_tick_and_the_end_stay_until_the_next_run() -> None:
    mirror = Mirror()
    mirror.begin_run(10.0)
    mirror.apply(Tree([NODE]))
    mirror.apply(Tick(n=1, changed=[], flashed=[(1, "FAILURE")], duration_ms=1.0, past=[(1, "FAILURE")]))
    mirror.apply(end := Finished("FAILURE", "root_finished", node_path="A::1"))
    assert (mirror.snapshot().past, mirror.snapshot().finished) == ([(1, "FAILURE")], end)
    mirror.begin_run(10.0)
    assert (mirror.snapshot().past, mirror.snapshot().finished) == ([], None)


def test_a_port_has_its_last_text_until_the_next_run() -> None:
    mirror = Mirror()
    mirror.begin_run(10.0)
    first = PortSet("n1", "T", "A::1", "speed", "0.5", "0.3", "next_tick")
    mirror.apply(first)
    mirror.apply(other := PortSet("n1", "T", "A::1", "angle", "1", None, "next_start"))
    mirror.apply(last := structs.replace(first, value="0.7"))
    assert mirror.snapshot().ports == [last, other]
    mirror.begin_run(10.0)
    assert mirror.snapshot().ports == []


def test_a_mismatch_stays_until_it_is_resolved_or_the_world_ends() -> None:
    mirror = Mirror()
    mirror.apply(StateChanged(State.UNIVERSE_READY.value))
    found = TopicMismatch("/scan", "/world", "/a", "qos", "Nothing arrives.", "Do this.", "durability")
    mirror.apply(found)
    mirror.apply(found)
    mirror.begin_run(10.0)
    assert mirror.snapshot().mismatches == [found]
    mirror.apply(structs.replace(found, resolved=True))
    assert mirror.snapshot().mismatches == []
    mirror.apply(found)
    mirror.apply(StateChanged(State.CONNECTED.value))
    assert mirror.snapshot().mismatches == []


def test_a_launch_node_that_runs_again_has_no_fault() -> None:
    mirror = Mirror()
    mirror.apply(Fault("process", "beeper ended", file="launch/a.launch.yaml", line=3))
    mirror.apply(other := Fault("process", "the world ended"))
    node = LaunchNode("id", "beeper", "", "nodes/beeper.py", "launch/a.launch.yaml", 3, "failed")
    mirror.apply(LaunchNodes([node]))
    assert len(mirror.snapshot().faults) == 2
    node.state = "running"
    mirror.apply(LaunchNodes([node]))
    assert mirror.snapshot().faults == [other]


def test_the_kept_lines_know_where_runs_began() -> None:
    mirror = Mirror()
    mirror.begin_run(10.0)
    mirror.apply(Log("action", "info", "one"))
    mirror.begin_run(10.0)
    mirror.apply(Log("action", "info", "two"))
    snapshot = mirror.snapshot(hanging_s=4.0)
    assert (snapshot.runs, snapshot.run_starts, snapshot.hanging_s) == (2, [(0, 1), (1, 2)], 4.0)
    for number in range(LOG_LINES - 1):
        mirror.apply(Log("action", "info", str(number)))
    assert mirror.snapshot().run_starts == [(0, 2)]
    mirror.apply(Log("action", "info", "last"))
    assert mirror.snapshot().run_starts == []


def test_a_hold_at_a_line_of_python_is_known_until_the_program_continues():
    mirror = Mirror()
    hold = HeldInPython(3, [1, 3], 4)
    for over in (
        StateChanged(State.APPLICATION_RUNNING.value),
        Tick(n=4, changed=[], flashed=[], duration_ms=1.0),
        Held(3, [1, 3], "step over", [], "step", "before", 4),
    ):
        mirror.apply(StateChanged(State.HELD.value))
        mirror.apply(hold)
        assert mirror.snapshot().held_in_python is hold
        mirror.apply(over)
        assert mirror.snapshot().held_in_python is None
