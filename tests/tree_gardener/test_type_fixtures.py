"""Ports of any type, registered types and literals in JSON, as BehaviorTree.CPP 4.10 treats them.

`types.json` was written by `types.cpp` beside it, linked with BehaviorTree.CPP.
"""

from __future__ import annotations

import dataclasses
import json
import re
from pathlib import Path
from typing import Any, ClassVar

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import document
from tree_gardener import (
    AnyTypeAllowed,
    LoadError,
    Port,
    PortError,
    TickError,
    Tree,
    get_input,
    register_type,
    set_output,
)
from tree_gardener.blackboard import EMPTY
from tree_gardener.values import type_of_value

FIXTURES: dict[str, Any] = json.loads(
    (Path(__file__).parents[1] / "conformance" / "types.json").read_text(encoding="utf-8")
)
seen: dict[str, Any] = {}


@register_type
@dataclasses.dataclass(frozen=True)
class Point:
    x: float
    y: float


class Pair(tuple[int, int]):
    """Two numbers, which have a form as text and none in JSON."""

    __slots__ = ()


def pair(text: str) -> Pair:
    first, second = text.split(",")
    return Pair((int(first), int(second)))


register_type(Pair, from_string=pair)


def shown(value: Any) -> Any:
    """A value as the fixtures show it."""
    if value is EMPTY:
        return "empty"
    if isinstance(value, Point):
        return {"Point": [value.x, value.y]}
    if isinstance(value, Pair):
        return {"Pair": list(value)}
    if isinstance(value, list):
        points = [item for item in value if isinstance(item, Point)]
        return {"Points": [[item.x, item.y] for item in points]} if points else {"list": value}
    names = {bool: "bool", int: "int", float: "double", str: "string"}
    return {names[type(value)]: value}


def writer(kind: Any, value: Any) -> type:
    class Writing(py_trees.behaviour.Behaviour):
        OUTPUT_PORTS: ClassVar = {"out": Port(kind)}

        def update(self) -> PyTreesStatus:
            set_output(self, "out", value)
            return PyTreesStatus.SUCCESS

    return Writing


def reader(kind: Any) -> type:
    class Reading(py_trees.behaviour.Behaviour):
        INPUT_PORTS: ClassVar = {"in": Port(kind)}

        def update(self) -> PyTreesStatus:
            try:
                seen["read"] = shown(get_input(self, "in"))
            except PortError:
                seen["read"] = "refused"
                return PyTreesStatus.FAILURE
            return PyTreesStatus.SUCCESS

    return Reading


NODES = {
    "WInt": writer(int, 42),
    "WOne": writer(int, 1),
    "WDouble": writer(float, 2.5),
    "WWhole": writer(float, 3.0),
    "WText": writer(str, "word"),
    "WDigits": writer(str, "7"),
    "WBool": writer(bool, True),
    "WGenInt": writer(AnyTypeAllowed, 42),
    "WGenDouble": writer(AnyTypeAllowed, 2.5),
    "WGenText": writer(AnyTypeAllowed, "word"),
    "WAnyInt": writer(Any, 42),
    "WAnyText": writer(Any, "word"),
    "WPoint": writer(Point, Point(1, 2)),
    "RInt": reader(int),
    "RDouble": reader(float),
    "RText": reader(str),
    "RBool": reader(bool),
    "RGen": reader(AnyTypeAllowed),
    "RAny": reader(Any),
    "RPoint": reader(Point),
    "RPair": reader(Pair),
    "RPoints": reader(list[Point]),
    "RInts": reader(list[int]),
}


def outcome(body: str) -> dict[str, Any]:
    """Returns the result of a case in our engine."""
    seen.clear()
    try:
        tree = Tree.from_xml(document(f"<Sequence>{body}</Sequence>"), NODES)
    except LoadError:
        return {"status": "REFUSED"}
    found: dict[str, Any] = {}
    try:
        found["status"] = tree.tick_exactly_once().name
    except TickError:
        found["status"] = "THROWS"
    entry = tree.blackboard.entries.get("k")
    if entry is not None:
        found |= {"entry": shown(entry.value), "strong": entry.is_strong}
    return found | seen


def expected(case: dict[str, Any]) -> dict[str, Any]:
    """Returns the result of a case in BehaviorTree.CPP."""
    return {name: value for name, value in case.items() if name != "body"}


LISTS = "RPoints"
"""A list of a registered type is read from JSON here; BehaviorTree.CPP registers it for exports only."""


@pytest.mark.parametrize("case", FIXTURES["literals"], ids=lambda case: case["body"])
def test_literals_of_registered_types(case: dict[str, Any]) -> None:
    ours = outcome(case["body"])
    if LISTS in case["body"] and case["status"] != "SUCCESS" and ours["status"] == "SUCCESS":
        assert isinstance(ours["read"].get("Points", ours["read"].get("list")), list)
        return
    assert ours == expected(case)


DEVIATIONS = (
    # Port(Any) writes over an entry of another type, which BT::Any refuses.
    r"<W(Double|Whole|Text|Digits|Bool|GenDouble|GenText) .*<WAnyInt|<WBool .*<WAnyText",
    # An entry of BT::Any takes no string from a script until it holds one; that of Port(Any) is the reverse.
    r"<Script code=\"k := '.*(<RAny|<WAny)|<WAnyText .*<Script code=\"k := '",
    # A literal at a port of any type is a text; in BehaviorTree.CPP it has no type.
    r"\A<R(Gen|Any) in=\"[^{]",
    # A boolean entry takes a double as a boolean port does, and stays a boolean.
    r"<WBool .*<WGenDouble|k := 42.*<WBool|<WBool.*k := 42",
)


@pytest.mark.parametrize("case", FIXTURES["ports"], ids=lambda case: case["body"])
def test_ports_of_any_type(case: dict[str, Any]) -> None:
    deviates = any(re.search(pattern, case["body"]) for pattern in DEVIATIONS)
    assert (outcome(case["body"]) != expected(case)) is deviates


@pytest.mark.parametrize(
    ("value", "name"),
    [
        (True, "bool"),
        (3, "int"),
        (2**40, "int64"),
        (2.5, "double"),
        ("a", "string"),
        ([1], "list[int]"),
        ([], "any"),
        ([Point(1, 2)], "any"),
        (None, "any"),
        (Point(1, 2), "Point"),
    ],
)
def test_an_entry_gets_the_type_of_the_first_value(value: Any, name: str) -> None:
    assert type_of_value(value).name == name
