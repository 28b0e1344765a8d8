"""The blackboard as JSON, compared with BehaviorTree.CPP 4.10 (`types.json`)."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest

from tests.fakes.hostile_values import VALUES
from tests.tree_gardener.test_type_fixtures import FIXTURES, Point, shown
from tests.tree_gardener.trees import document
from tree_gardener import (
    PortError,
    SharedQueue,
    Status,
    Tree,
    blackboard_from_json,
    blackboard_to_json,
    tree_from_json,
    tree_to_json,
)
from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.board_json import value_to_json
from tree_gardener.values import ANY, INT, type_name_of, type_of_value

TYPES = {"int": "int", "double": "double", "bool": "bool", "std::string": "string", "decltype(nullptr)": None}
TOO_LARGE = 2**40
"""An import in BehaviorTree.CPP makes 0 of an integer of more than 32 bits; here it is kept."""


class Unknown:
    pass


def filled() -> Blackboard:
    board = Blackboard()
    values = {
        "int": 42, "big": 2**40, "unsigned": 7, "double": 2.5, "whole": 3.0, "bool": True, "text": "word",
        "ints": [1, 2], "doubles": [1.5, 2.0], "texts": ["a", "b"], "bools": [True, False],
        "point": Point(1.0, 2.0), "points": [Point(1.0, 2.0), Point(3.0, 4.0)],
        "unknown": Unknown(), "none": [],
    }  # fmt: skip
    board.update(values)
    board.create("empty", INT)
    return board


def test_an_export_is_that_of_behaviortree_cpp() -> None:
    found = blackboard_to_json(filled())
    assert found == FIXTURES["exported"]
    assert [type(found[key]) for key in ("bool", "whole")] == [int, float]


@pytest.mark.parametrize("case", FIXTURES["imported"], ids=str)
def test_an_import_is_that_of_behaviortree_cpp(case: dict[str, Any]) -> None:
    board = Blackboard()
    if case["typed"]:
        board.set("k", 7, INT)
    if case["entry"] == "THROWS":
        with pytest.raises(PortError, match="the entry 'k' cannot be read from JSON"):
            blackboard_from_json({"k": case["value"]}, board)
        return
    left = blackboard_from_json({"k": case["value"]}, board)
    entry = board.find("k")
    if case["entry"] is None:
        assert (entry, left) == (None, ["k"])
        return
    assert entry is not None
    if case["value"] == TOO_LARGE:
        assert entry.value == TOO_LARGE
        return
    assert (shown(entry.value), entry.sequence) == (case["entry"], case["sequence"])
    if case["typed"]:
        assert entry.type is INT
    elif case["type"] in TYPES:
        assert (entry.type.name if entry.type else None) == TYPES[case["type"]]
    assert left == (["k"] if case["value"] in ([], {}) or _is_unknown(case["value"]) else [])


def _is_unknown(value: Any) -> bool:
    if isinstance(value, list):
        return bool(value) and isinstance(value[0], list)
    return isinstance(value, dict) and value.get("__type") != "Point"


def test_what_was_exported_reads_back() -> None:
    first, second = filled(), Blackboard()
    left = blackboard_from_json(blackboard_to_json(first), second)
    assert left == ["none"]
    assert second["points"] == first["points"]
    assert second.entries["empty"].value is EMPTY
    assert type_name_of(second["big"]) == "int"


def test_what_has_no_form_in_json_is_null() -> None:
    values = [math.nan, math.inf, Status.SUCCESS, SharedQueue([1]), {"a": 1}, [1, Unknown()], [[1], [2]]]
    assert [value_to_json(value) for value in values] == [None] * 7
    ring: list[Any] = []
    ring.append(ring)
    assert value_to_json(ring) is None
    assert type_of_value(ring) is ANY


def test_an_import_is_seen_by_observers() -> None:
    board, told = Blackboard(), []
    board.journal = lambda entry, writer: told.append((entry.key, entry.value, writer))
    blackboard_from_json({"a": 1, "b": {}}, board)
    assert told == [("a", 1, 0)]


BODY = '<Sequence><Script code="a := 1"/><SubTree ID="Inner" name="inner" c="5" shared="{a}"/></Sequence>'
INNER = '<BehaviorTree ID="Inner"><Script code="d := 2.5; shared := 9"/></BehaviorTree>'


def test_a_tree_has_its_scopes_by_name() -> None:
    tree = Tree.from_xml(document(BODY).replace("</root>", f"{INNER}</root>"))
    tree.tick_exactly_once()
    found = tree_to_json(tree)
    [main] = found.keys() - {"inner"}
    assert (found[main], found["inner"]) == ({"a": 9}, {"c": 5, "d": 2.5})
    assert FIXTURES["tree"]["inner"] == found["inner"]
    assert tree_from_json({main: {"a": 3}, "inner": {"d": 1, "e": {}}}, tree) == ["inner/e"]
    assert (tree.blackboard["a"], tree.boards[1]["d"], tree.boards[1]["shared"]) == (3, 1, 3)
    with pytest.raises(PortError, match="the document has the scopes none, and the tree has"):
        tree_from_json({}, tree)


def test_any_value_has_a_form_or_none() -> None:
    for value in VALUES:
        json.dumps([value_to_json(value), value_to_json([value]), value_to_json((1, value))])
    assert value_to_json(2**64) is None
    assert value_to_json([2**64 - 1, -(2**63), True]) == [2**64 - 1, -(2**63), True]
