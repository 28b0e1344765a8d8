"""Backups of the blackboard, compared with BehaviorTree.CPP 4.10 (`types.json`)."""

from __future__ import annotations

import json
from typing import Any

import pytest

from tests.tree_gardener.test_type_fixtures import FIXTURES, shown
from tree_gardener import SharedQueue, Tree, backup, restore

TEXT = """<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main"><Sequence>
<Script code="a := 1; b := 'x'"/><SubTree ID="Inner" name="inner" c="5" shared="{a}"/>
</Sequence></BehaviorTree>
<BehaviorTree ID="Inner"><Script code="d := 2.5; shared := 9"/></BehaviorTree></root>"""


def entries(tree: Tree) -> Any:
    scopes = {
        board.path: {key: [shown(entry.value), entry.sequence] for key, entry in board.entries.items()}
        for board in tree.boards
    }
    return json.loads(json.dumps(scopes))


def test_a_backup_is_restored_as_in_behaviortree_cpp() -> None:
    tree = Tree.from_xml(TEXT)
    tree.tick_exactly_once()
    steps = [entries(tree)]
    saved = backup(tree)
    tree.blackboard.set("a", 100)
    tree.blackboard.set("new", 1)
    tree.blackboard.unset("b")
    tree.boards[1].set("d", 7.5)
    steps.append(entries(tree))
    restore(tree, saved)
    steps.append(entries(tree))
    assert steps == FIXTURES["backup"]


def test_containers_are_copied_and_other_objects_are_shared() -> None:
    tree = Tree.from_xml(TEXT)
    queue = SharedQueue([1])
    tree.blackboard.update({"path": [[1], {"a": {2}}], "pair": ([1],), "queue": queue})
    saved = backup(tree)
    tree.blackboard["path"][0].append(5)
    tree.blackboard["path"][1]["a"].add(3)
    tree.blackboard["pair"][0].append(5)
    queue.append(2)
    restore(tree, saved)
    assert tree.blackboard["path"] == [[1], {"a": {2}}]
    assert tree.blackboard["pair"] == ([1],)
    assert tree.blackboard["queue"] is queue
    tree.blackboard["path"].append(7)
    restore(tree, saved)
    assert tree.blackboard["path"] == [[1], {"a": {2}}]


def nested(levels: int) -> list[Any]:
    value: list[Any] = []
    for _ in range(levels - 1):
        value = [value]
    return value


def test_a_value_that_holds_itself_is_refused_with_its_entry() -> None:
    ring: list[Any] = []
    ring.append(ring)
    own: dict[str, Any] = {}
    own["all"] = (own, own)
    for value in (ring, own, nested(101), nested(100_000)):
        tree = Tree.from_xml(TEXT)
        tree.blackboard.set("kept", value)
        with pytest.raises(ValueError, match="the entry 'kept' is nested too deeply"):
            backup(tree)
    tree.blackboard.set("kept", nested(100))
    restore(tree, backup(tree))
    assert tree.blackboard["kept"] == nested(100)


def test_what_is_shared_within_an_entry_is_copied_once() -> None:
    value: list[Any] = [1]
    for _ in range(60):
        value = [value, value]
    tree = Tree.from_xml(TEXT)
    tree.blackboard.set("kept", value)
    restore(tree, backup(tree))
    found = tree.blackboard["kept"]
    assert found is not value
    assert found[0] is found[1]


def test_the_tree_runs_on_after_it() -> None:
    tree = Tree.from_xml(TEXT)
    before = backup(tree)
    tree.tick_exactly_once()
    restore(tree, before)
    assert "a" not in tree.blackboard
    tree.tick_exactly_once()
    assert (tree.blackboard["a"], tree.boards[1]["d"]) == (9, 2.5)


def test_observers_receive_the_entries() -> None:
    tree = Tree.from_xml(TEXT)
    seen: list[Any] = []
    tree.observe(lambda changes: seen.append({(each.scope, each.key) for each in changes.blackboard}))
    saved = backup(tree)
    tree.tick_exactly_once()
    restore(tree, saved)
    tree.halt()
    assert ("", "a") in seen[-1]


def test_a_backup_of_another_tree_is_refused() -> None:
    tree = Tree.from_xml(TEXT)
    with pytest.raises(ValueError, match="the backup has 1 scopes, and the tree has 2"):
        restore(tree, backup(tree)[:1])
