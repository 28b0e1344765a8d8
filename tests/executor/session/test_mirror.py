"""The state that a late client gets."""

from __future__ import annotations

from executor.messages import (
    Blackboard,
    BlackboardEntry,
    Fault,
    Finished,
    LaunchNode,
    LaunchNodes,
    Log,
    StateChanged,
    Tick,
    Tree,
    TreeNode,
)
from executor.session.ladder import State
from executor.session.mirror import FAULTS, LOG_LINES, Mirror

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
