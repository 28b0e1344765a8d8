"""The running tree in the format of the older monitor."""

from __future__ import annotations

import json

from executor.messages import Blackboard, BlackboardEntry, Tick, Tree, TreeNode
from executor.ram.monitor import update_text
from executor.session.mirror import Mirror


def node(uid: int, parent: int, type_: str, name: str = "") -> TreeNode:
    return TreeNode(
        uid=uid, parent=parent, type=type_, kind="action", name=name, path="", node_id="", tree_id=""
    )


def test_nodes_lie_in_their_parents_and_equal_names_are_numbered() -> None:
    mirror = Mirror()
    mirror.apply(Tree([node(1, 0, "Sequence"), node(2, 1, "Go", "go"), node(3, 1, "Go", "go")]))
    mirror.apply(Tick(n=1, changed=[(1, "RUNNING"), (3, "FAILURE")], flashed=[], duration_ms=1.0))
    mirror.apply(Blackboard([BlackboardEntry("Arm", "k", "int", 5, False, False)]))
    found = json.loads(update_text(mirror))
    assert found == {
        "tree": {"Sequence": {"state": "RUNNING", "go": {"state": "INVALID"}, "go_2": {"state": "FAILURE"}}},
        "blackboard": {"Arm/k": "5"},
    }


def test_without_a_tree_it_is_empty() -> None:
    assert json.loads(update_text(Mirror())) == {"tree": {}, "blackboard": {}}
