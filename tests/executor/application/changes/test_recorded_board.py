"""The blackboard of a recording, in a tree that begins."""

from __future__ import annotations

import json
from typing import Any

import pytest
from py_trees.blackboard import Blackboard

from executor.application.changes.recorded_board import restore, said_of
from tree_gardener import Tree

TEXT = """<root BTCPP_format='4' main_tree_to_execute='Main'>
<BehaviorTree ID='Main'><Sequence>
<SubTree ID='Part' name='part'/><Script code='typed := 1.5'/>
</Sequence></BehaviorTree>
<BehaviorTree ID='Part'><AlwaysSuccess/></BehaviorTree></root>"""


def tree() -> Tree:
    return Tree.from_xml(TEXT)


def given(*rows: Any) -> tuple[Tree, list[str]]:
    made = tree()
    return made, restore(made, json.dumps(rows))


def test_plain_values_are_written() -> None:
    made, empty = given(
        ["", "n", "int", 3], ["", "x", "double", 2], ["", "s", "string", "a"], ["", "l", "list", [1, "b"]]
    )
    assert empty == []
    assert dict(made.blackboard) == {"n": 3, "x": 2.0, "s": "a", "l": [1, "b"]}
    assert type(made.blackboard["x"]) is float


def test_scopes_of_subtrees_are_written() -> None:
    made = tree()
    (path,) = [board.path for board in made.boards if board.path]
    assert restore(made, json.dumps([[path, "k", "bool", True]])) == []
    assert made.blackboard.scope(path)["k"] is True
    assert "k" not in made.blackboard


def test_what_the_recording_does_not_hold_is_left_empty_and_named() -> None:
    made, empty = given(
        ["", "picture", "ndarray", {"preview": "array(...)"}],
        ["", "long", "string", {"preview": "aaa", "bytes": 9000, "hash": "00"}],
        ["", "pose", "Pose", [1, 2]],
        ["gone", "k", "int", 1],
        ["", "declared", "empty", None],
        ["", "n", "int", 1],
    )
    assert empty == ["picture", "long", "pose", "gone/k"]
    assert dict(made.blackboard) == {"n": 1}


@pytest.mark.parametrize("text", ["", "no", "{}", "[1]", '[["","k",1,2]]', '[["","k","int"]]'])
def test_what_is_no_blackboard_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"recorded|Expecting"):
        restore(tree(), text)


def test_the_first_entries_that_are_left_empty_are_named() -> None:
    said = "Left empty, since the recording does not hold these values: "
    assert said_of(["a", "b"]) == f"{said}a, b."
    assert said_of(["k"] * 23) == f"{said}{', '.join(['k'] * 20)}, and 3 more."


def test_keys_of_py_trees_are_written_where_its_clients_read_them() -> None:
    Blackboard.clear()
    try:
        _, empty = given(
            ["py_trees:/robot/", "speed", "double", 2],
            ["py_trees:/robot/", "pose", "Pose", [1]],
            ["py_trees:patrol", "Sequence", "Status", "RUNNING"],
        )
        assert empty == ["py_trees:/robot//pose"]
        assert repr(Blackboard.get("/robot/speed")) == "2.0"
    finally:
        Blackboard.clear()
