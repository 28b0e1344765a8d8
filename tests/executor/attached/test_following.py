"""Each look at another program tells what has changed since the last."""

from __future__ import annotations

from executor.attached.following import Boards, Statuses, type_name
from tree_gardener.groot.remote import NodeState
from tree_gardener.status import Status

IDLE, RUNNING, SUCCESS, FAILURE = Status.IDLE, Status.RUNNING, Status.SUCCESS, Status.FAILURE


def test_a_look_tells_changes_results_that_flash_and_the_past() -> None:
    statuses = Statuses({10: 1, 20: 2})
    first = statuses.take({10: NodeState(RUNNING), 20: NodeState(IDLE, SUCCESS)}, 0.5)
    assert (first.n, first.t, first.changed, first.flashed) == (1, 0.5, [(1, "RUNNING")], [])
    assert first.past == [(2, "SUCCESS")]
    assert statuses.awake() == [(1, "RUNNING")]
    second = statuses.take({10: NodeState(IDLE, FAILURE), 20: NodeState(IDLE, SUCCESS)}, 0.6)
    assert (second.changed, second.flashed) == ([(1, "IDLE")], [(1, "FAILURE")])
    assert statuses.looks == 2


def test_nodes_that_are_not_in_the_tree_are_dropped_and_counted() -> None:
    statuses = Statuses({1: 1})
    tick = statuses.take({1: NodeState(SUCCESS), 77: NodeState(RUNNING)}, 0.0)
    assert tick.changed == [(1, "SUCCESS")]
    assert statuses.dropped == 1


def test_blackboards_tell_new_changed_and_removed_entries() -> None:
    boards = Boards()
    shown, rows = boards.take({"Main": {"a": 1, "b": 1.5}, "Sub::6": {"x": "y"}}, "Main")
    assert [(each.scope, each.key, each.type, each.value) for each in shown] == [
        ("", "a", "int", 1),
        ("", "b", "double", 1.5),
        ("Sub::6", "x", "string", "y"),
    ]
    assert rows[2] == ("Sub::6", "x", "string", '"y"', False)
    assert boards.take({"Main": {"a": 1, "b": 1.5}, "Sub::6": {"x": "y"}}, "Main") == ([], [])
    shown, rows = boards.take({"Main": {"a": True, "b": 1.5}}, "Main")
    assert [(each.scope, each.key, each.value, each.removed) for each in shown] == [
        ("", "a", True, False),
        ("Sub::6", "x", None, True),
    ]
    assert rows[1] == ("Sub::6", "x", "string", "null", True)


def test_values_that_are_no_plain_ones_have_any_type() -> None:
    assert type_name({"x": 1}) == "any"
    nested: object = 1
    for _ in range(500):
        nested = [nested]
    shown, rows = Boards().take({"Main": {"deep": nested}}, "Main")
    assert shown[0].preview
    assert "preview" in rows[0][3]
