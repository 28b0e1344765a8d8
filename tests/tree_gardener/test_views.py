"""Views for py_trees' tools."""

from __future__ import annotations

import py_trees
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import leaf, load
from tree_gardener import Status
from tree_gardener.node import Node
from tree_gardener.observe import TickChanges
from tree_gardener.views import describe_changes, view_of

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE


def test_py_trees_tools_work_on_the_tree() -> None:
    tree = load(
        "<Sequence><Fallback><Failing/><Succeeding name='ok'/></Fallback>"
        "<ParallelAll><Inverter><Failing/></Inverter></ParallelAll><Running name='drive'/>"
        "<Script code='x:=1'/></Sequence>"
    )
    text = py_trees.display.ascii_tree(tree.root, show_status=True)
    assert "drive [-]" in text
    visitor = py_trees.visitors.SnapshotVisitor()
    behaviour_tree = py_trees.trees.BehaviourTree(tree.root)
    behaviour_tree.visitors.append(visitor)
    behaviour_tree.setup(node=None)
    behaviour_tree.tick()
    assert behaviour_tree.root.status is R
    statuses = {node.name: node.status for node in behaviour_tree.root.iterate()}
    assert (statuses["ok"], statuses["drive"], statuses["Fallback"]) == (S, R, S)
    assert leaf(tree, "drive").id in visitor.visited
    assert py_trees.display.dot_tree(tree.root).get_nodes()
    behaviour_tree.root.stop(py_trees.common.Status.INVALID)
    assert tree.nodes[0].status is Status.IDLE
    behaviour_tree.root.tick_once()
    assert behaviour_tree.root.status is R


def test_a_node_has_one_view_whose_status_follows() -> None:
    tree = load("<Sequence><Inverter><Failing/></Inverter></Sequence>")
    view = view_of(tree.root if isinstance(tree.root, Node) else tree.nodes[0])
    assert view is view_of(tree.nodes[0])
    assert [child.qualified_name for child in view.children] == ["Inverter/Inverter"]


def test_the_changes_of_a_tick_are_one_line() -> None:
    tree = load("<Sequence><Running/></Sequence>")
    changes = TickChanges(1, [(1, Status.RUNNING)], [(2, Status.SUCCESS)], [], 0.0)
    assert describe_changes(changes, tree).endswith(f"{tree.nodes[0].path} RUNNING")
    assert describe_changes(TickChanges(2, [], [], [], 0.0), tree) == "no change"
