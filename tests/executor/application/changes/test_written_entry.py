"""An entry of the blackboard that a person writes while the tree runs."""

from __future__ import annotations

from executor.application.changes.written_entry import write
from tree_gardener import Tree
from tree_gardener.values import INT

TEXT = """<root BTCPP_format='4' main_tree_to_execute='Main'>
<BehaviorTree ID='Main'><Sequence>
<SubTree ID='Part' name='part'/><Script code='typed := 1.5'/>
</Sequence></BehaviorTree>
<BehaviorTree ID='Part'><AlwaysSuccess/></BehaviorTree></root>"""


def test_an_entry_is_written_in_its_scope() -> None:
    tree = Tree.from_xml(TEXT)
    (scope,) = [board.path for board in tree.boards if board.path]
    assert write(tree, "", "found", "crate") == ""
    assert write(tree, scope, "found", [1, 2]) == ""
    assert (tree.blackboard.get("found"), tree.blackboard.scope(scope).get("found")) == ("crate", [1, 2])


def test_a_whole_number_over_a_double_stays_a_double() -> None:
    tree = Tree.from_xml(TEXT)
    tree.tick_once()
    assert write(tree, "", "typed", 3) == ""
    assert type(tree.blackboard.get("typed")) is float


def test_why_an_entry_cannot_be_written_is_said() -> None:
    tree = Tree.from_xml(TEXT)
    tree.tick_once()
    assert write(tree, "no/such", "found", 1) == "There is no subtree 'no/such'."
    tree.blackboard.create("count", INT)
    tree.blackboard["count"] = 2
    why = write(tree, "", "count", "many")
    assert "count" in why
    assert why.endswith(".")
    assert tree.blackboard.get("count") == 2


def test_an_entry_of_py_trees_is_only_read() -> None:
    why = write(Tree.from_xml(TEXT), "py_trees:/robot/", "speed", 1)
    assert why == "The entry 'speed' is one of py_trees: only its clients can write it."
