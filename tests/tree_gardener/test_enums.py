"""Enumerations: constants of scripts, and types of ports."""

from __future__ import annotations

import enum
from typing import Any, ClassVar

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import document
from tree_gardener import LoadError, Port, Status, TickError, Tree, get_input
from tree_gardener.document import parse_document
from tree_gardener.enums import constants, read_enums, types
from tree_gardener.values import ConversionError

COLOR = {"RED": 0, "GREEN": 7}
BROUGHT = """<root BTCPP_format="4"><BehaviorTree ID="T"><Sequence>{body}</Sequence></BehaviorTree>
<Enums><Enum name="Color"><Value name="RED" value="{red}"/><Value name="GREEN" value="7"/></Enum></Enums>
</root>"""


class Gear(enum.IntEnum):
    PARKED = 0
    AHEAD = 1


class Paint(py_trees.behaviour.Behaviour):
    INPUT_PORTS: ClassVar = {"color": Port("Color", default="RED"), "gear": Port(Gear, default=Gear.PARKED)}

    def update(self) -> PyTreesStatus:
        self.seen = (get_input(self, "color"), get_input(self, "gear"))
        return PyTreesStatus.SUCCESS


def painted(body: str, **more: Any) -> Any:
    tree = Tree.from_xml(body, {"Paint": Paint}, **more)
    assert tree.tick_once() is Status.SUCCESS
    return next(node.behaviour for node in tree.nodes if node.type == "Paint").seen


@pytest.mark.parametrize(
    ("ports", "number"),
    [("", 0), ('color="GREEN"', 7), ('color="9"', 9), ('color="{number}"', 7), ('color="{text}"', 7)],
)
def test_a_port_of_an_enumeration_takes_names_and_numbers(ports: str, number: int) -> None:
    body = f"<Script code=\"number := GREEN; text := 'GREEN'\"/><Paint {ports}/>"
    assert painted(document(f"<Sequence>{body}</Sequence>"), enums={"Color": COLOR}) == (number, Gear.PARKED)


def test_a_port_of_an_enum_class_reads_the_double_of_a_script() -> None:
    body = document('<Sequence><Script code="g := AHEAD"/><Paint gear="{g}"/></Sequence>')
    assert painted(body, enums={"Color": COLOR, "AHEAD": 1}) == (0, Gear.AHEAD)


def test_a_name_of_another_enumeration_is_refused() -> None:
    with pytest.raises(LoadError, match="'BLUE' is not one of RED, GREEN"):
        Tree.from_xml(document('<Paint color="BLUE"/>'), {"Paint": Paint}, enums={"Color": COLOR})
    body = document("<Sequence><Script code=\"c := 'BLUE'\"/><Paint color='{c}'/></Sequence>")
    tree = Tree.from_xml(body, {"Paint": Paint}, enums={"Color": COLOR})
    with pytest.raises(TickError, match="'BLUE' is not one of RED, GREEN"):
        tree.tick_once()


def test_a_document_brings_its_enumerations() -> None:
    text = BROUGHT.format(red=3, body='<ScriptCondition code="GREEN == 7 &amp;&amp; RED == 3"/><Paint/>')
    assert painted(text) == (3, Gear.PARKED)
    assert read_enums(parse_document(text)) == {"Color": {"RED": 3, "GREEN": 7}}


def test_a_bad_number_of_a_document_is_located() -> None:
    with pytest.raises(LoadError) as caught:
        Tree.from_xml(BROUGHT.format(red="many", body="<AlwaysSuccess/>"))
    [found] = caught.value.diagnostics
    assert (found.code, found.line) == ("TG605", 2)


def test_one_name_has_one_number() -> None:
    assert constants({"A": {"X": 1}, "B": {"X": 1, "Y": 2}, "Z": 3}) == {"X": 1, "Y": 2, "Z": 3}
    with pytest.raises(LoadError, match="'X' is 1 and 2"):
        constants({"A": {"X": 1}, "X": 2})


def test_only_enumerations_are_types() -> None:
    kinds = types({"Color": COLOR, "Z": 3})
    assert list(kinds) == ["Color"]
    assert [kinds["Color"].convert(value) for value in (7.0, "GREEN", True)] == [7, 7, 1]
    with pytest.raises(ConversionError):
        kinds["Color"].convert([])
