"""Ports: declared, read, written, converted; those of py_trees and of the older contract too."""

from __future__ import annotations

import enum
from typing import Any, ClassVar

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import load
from tree_gardener import LoadError, Port, PortError, TickError, get_input, set_output
from tree_gardener.ports import pointer_key


class Gear(enum.Enum):
    LOW = 1
    HIGH = 2


class Image:
    pass


class Probe(py_trees.behaviour.Behaviour):
    INPUT_PORTS: ClassVar = {
        "number": Port(int),
        "real": Port(float, default=1.5),
        "flag": Port(bool, default=False),
        "gear": Port(Gear, default=Gear.LOW),
        "numbers": Port(list[float]),
        "image": Port(Image),
        "linked": Port(str, default="{=}"),
        "anything": Port(),
    }
    OUTPUT_PORTS: ClassVar = {"result": Port(int), "picture": Port(Image)}
    INOUT_PORTS: ClassVar = {"count": Port(int, default="{count}")}

    def update(self) -> PyTreesStatus:
        return PyTreesStatus.SUCCESS


def probe(attributes: str = "", **entries: Any) -> Any:
    tree = load(f"<Probe {attributes}/>", nodes={"Probe": Probe})
    for key, value in entries.items():
        tree.blackboard[key] = value
    return tree.nodes[0].behaviour


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("{key}", "key"),
        (" {key} ", "key"),
        ("{a b}", "a b"),
        ("{=}", "port"),
        ("{}", None),
        ("key", None),
        ("{a", None),
    ],
)
def test_what_is_a_pointer(text: str, expected: str | None) -> None:
    assert pointer_key(text, "port") == expected


@pytest.mark.parametrize(
    ("port", "text", "expected"),
    [
        *(("number", "12", 12), ("number", "-3", -3), ("number", "12abc", 12), ("number", "5.7", 5)),
        *(("real", "2", 2.0), ("real", "1e3", 1000.0), ("flag", "true", True), ("flag", "0", False)),
        *(("gear", "HIGH", Gear.HIGH), ("gear", "2", Gear.HIGH)),
        *(("numbers", "1;2.5", [1.0, 2.5]), ("numbers", "json:[1, 2]", [1.0, 2.0]), ("anything", "x", "x")),
    ],
)
def test_literals_are_read_as_the_ports_type(port: str, text: str, expected: object) -> None:
    assert get_input(probe(f'{port}="{text}"'), port) == expected


@pytest.mark.parametrize(
    ("port", "text"),
    [
        *(("number", " 5"), ("number", "+5"), ("number", "yes"), ("number", "99999999999"), ("real", "x")),
        *(("flag", "yes"), ("gear", "MIDDLE"), ("numbers", "1;x"), ("numbers", "json:{}"), ("image", "x")),
        *(("numbers", "json:["),),
    ],
)
def test_other_literals_are_refused_at_load(port: str, text: str) -> None:
    with pytest.raises(LoadError, match=f"the port '{port}'"):
        probe(f'{port}="{text}"')


def test_defaults_are_values_or_entries() -> None:
    behaviour = probe(linked="entry", count=4)
    assert get_input(behaviour, "real") == 1.5
    assert get_input(behaviour, "gear") is Gear.LOW
    assert get_input(behaviour, "linked") == "entry"
    assert get_input(behaviour, "count") == 4


def test_entries_convert_when_nothing_is_lost() -> None:
    assert get_input(probe('number="{n}"', n=2.0), "number") == 2
    assert get_input(probe('real="{n}"', n=2), "real") == 2.0
    assert get_input(probe('linked="{n}"', n=2.5), "linked") == "2.500000"
    with pytest.raises(PortError, match=r"holds a whole number: 2\.5 is not a whole number"):
        probe('number="{n}"', n=2.5)
    untyped = probe('anything="{n}"', n=2.5)
    untyped.tree_gardener_node.board["n"] = "text"
    assert get_input(untyped, "anything") == "text"


def test_objects_pass_by_reference() -> None:
    image = Image()
    behaviour = probe('image="{image}" picture="{image}"')
    set_output(behaviour, "picture", image)
    assert get_input(behaviour, "image") is image
    with pytest.raises(PortError, match="takes a value of type"):
        set_output(behaviour, "picture", 3)


@pytest.mark.parametrize(
    ("use", "message"),
    [
        (lambda b: get_input(b, "number"), "was given no value"),
        (lambda b: get_input(b, "nothing"), "is not a port of Probe"),
        (lambda b: get_input(b, "result"), "has no default"),
        (lambda b: set_output(b, "number", 1), "is an input"),
        (lambda b: set_output(b, "result", 1), "leads to no entry"),
        (lambda b: set_output(b, "nothing", 1), "is not a port of Probe"),
        (lambda b: get_input(b, "linked"), "does not exist"),
    ],
)
def test_what_cannot_be_done_is_said(use: Any, message: str) -> None:
    with pytest.raises(PortError, match=message):
        use(probe())


def test_ports_need_a_tree() -> None:
    with pytest.raises(PortError, match="not in a tree yet"):
        get_input(Probe("alone"), "real")


def test_a_declared_entry_without_value_cannot_be_read() -> None:
    with pytest.raises(PortError, match="has no value yet"):
        get_input(probe('number="{n}"'), "number")


def test_built_in_nodes_miss_their_ports_when_ticked() -> None:
    tree = load("<Repeat><Succeeding/></Repeat>")
    with pytest.raises(TickError, match=r"'Repeat::1'.*'num_cycles' was given no value"):
        tree.tick_once()
