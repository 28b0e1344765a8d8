"""The port functions of older actions."""

from __future__ import annotations

import py_trees
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import load, subtree
from tree_gardener import Status, tree_tools


class Legacy(py_trees.behaviour.Behaviour):
    def __init__(self, name: str, ports: dict[str, str] | None = None) -> None:
        super().__init__(name)
        self.ports = ports or {}

    def update(self) -> PyTreesStatus:
        value = tree_tools.get_port_content(self.ports["source"])
        try:
            tree_tools.set_port_content(self.ports["target"], value)
        except ValueError:
            return PyTreesStatus.FAILURE
        return PyTreesStatus.SUCCESS


def test_the_older_contract_works_in_subtrees_too() -> None:
    tree = load(
        '<SubTree ID="Inner" outside="{there}"/>',
        subtree("Inner", '<Copy source="1.5" target="{outside}"/>'),
        nodes={"Copy": Legacy},
    )
    assert tree.tick_once() is Status.SUCCESS
    assert tree.blackboard["there"] == "1.5"


def test_the_older_contract_reads_unset_entries_as_nothing_and_writes_no_literals() -> None:
    tree = load('<Copy source="{nothing}" target="{to}"/>', nodes={"Copy": Legacy})
    tree.tick_once()
    assert tree.blackboard["to"] == ""
    assert load('<Copy source="1" target="text"/>', nodes={"Copy": Legacy}).tick_once() is Status.FAILURE
    # A text that was split belongs to the tree that was made last.
    tree_tools.set_port_content("{" + "plain}", 3)
    assert tree_tools.get_port_content("{plain}") == 3
    assert tree_tools.get_port_content("literal") == "literal"
