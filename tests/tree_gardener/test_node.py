"""Places and kinds of nodes."""

from __future__ import annotations

import pytest

from tests.tree_gardener.trees import load, subtree
from tree_gardener import Status
from tree_gardener.node import Kind


def test_nodes_say_where_they_are() -> None:
    tree = load(
        '<Sequence _bts_id="n1"><SubTree ID="Arm" name="left"/><SubTree ID="Arm"/></Sequence>',
        subtree("Arm", "<Inverter><Succeeding name='grip'/></Inverter>"),
    )
    assert [
        (node.uid, node.parent.uid if node.parent else 0, node.path, node.tree_id) for node in tree.nodes
    ] == [
        (1, 0, "Sequence::1", "Main"),
        (2, 1, "left", "Main"),
        (3, 2, "left/Inverter::3", "Arm"),
        (4, 3, "left/grip", "Arm"),
        (5, 1, "Arm::5", "Main"),
        (6, 5, "Arm::5/Inverter::6", "Arm"),
        (7, 6, "Arm::5/grip", "Arm"),
    ]
    assert tree.nodes[0].node_id == "n1"
    assert repr(tree.nodes[3]) == "<Succeeding 'left/grip' IDLE>"
    tree.blackboard.scope("left")["x"] = 1
    assert tree.blackboard.scope("left")["x"] == 1
    assert tree.blackboard.scope("") is tree.blackboard
    with pytest.raises(KeyError):
        tree.blackboard.scope("nowhere")


def test_nodes_have_the_kind_of_their_class() -> None:
    tree = load("<Sequence><Inverter><AlwaysSuccess/></Inverter><ScriptCondition code='1'/></Sequence>")
    kinds = [Kind.CONTROL, Kind.DECORATOR, Kind.ACTION, Kind.CONDITION]
    assert [node.kind for node in tree.nodes] == [kind.value for kind in kinds]
    tree.tick_exactly_once()
    assert all(node.status is Status.IDLE for node in tree.nodes[1:])
