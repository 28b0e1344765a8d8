"""Constants, ports and problems of the builder of a tree."""

from __future__ import annotations

import pytest

from tests.tree_gardener.trees import LEAVES, load
from tree_gardener import LoadError, Tree
from tree_gardener.loader import MAX_PROBLEMS, bound_ports, constant
from tree_gardener.values import DOUBLE, INT, INT_64


def test_a_constant_of_a_subtree_has_the_type_that_it_looks_like() -> None:
    assert constant("5") == (5, INT)
    assert constant(str(2**40)) == (2**40, INT_64)
    assert constant("1e3") == (1000.0, DOUBLE)
    assert constant("text") == ("text", None)


def test_the_ports_of_an_older_action_know_their_scope() -> None:
    tree = load("<Delay delay_msec='5'><Succeeding/></Delay>")
    ports = bound_ports(tree.nodes[0])
    assert ports == {"delay_msec": "5"}
    assert ports["delay_msec"].board is tree.blackboard  # type: ignore[attr-defined]


def test_the_list_of_problems_ends_somewhere() -> None:
    wrong = "<Delay delay_msec='x'><Succeeding/></Delay>" * (2 * MAX_PROBLEMS)
    text = f'<root><BehaviorTree ID="A"><Sequence>{wrong}</Sequence></BehaviorTree></root>'
    with pytest.raises(LoadError) as refused:
        Tree.from_xml(text, LEAVES)
    assert len(refused.value.diagnostics) == MAX_PROBLEMS
