"""An action of a loaded tree raises while its fault is on."""

import py_trees
import pytest

from executor.evaluation.action_faults import MESSAGE, switch_action
from tree_gardener import Tree
from tree_gardener.errors import TickError

XML = """<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main"><Go _bts_id="a" name="go"/></BehaviorTree>
</root>"""


class Go(py_trees.behaviour.Behaviour):
    """Runs."""

    def update(self):
        return py_trees.common.Status.RUNNING


def test_an_action_raises_while_its_fault_is_on():
    tree = Tree.from_xml(XML, {"Go": Go})
    [node] = [node for node in tree.nodes if node.node_id]
    assert tree.tick_once().name == "RUNNING"
    switch_action(tree, node.tree_id, "another", on=True)
    assert tree.tick_once().name == "RUNNING"
    switch_action(tree, node.tree_id, node.node_id, on=True)
    with pytest.raises(TickError, match=MESSAGE):
        tree.tick_once()
    switch_action(tree, node.tree_id, node.node_id, on=False)
    assert tree.tick_once().name == "RUNNING"
