"""Types that users register, with their forms as text and JSON."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import pytest

from tree_gardener import register_type
from tree_gardener.registered import registered, registered_name
from tree_gardener.values import ConversionError, to_text, value_type


@register_type(
    from_string=lambda text: Spot(*map(float, text.split(","))), to_string=lambda p: f"{p.x},{p.y}"
)
@dataclasses.dataclass
class Spot:
    x: float
    y: float = 0.0


@register_type(name="Place")
@dataclasses.dataclass
class Named:
    name: str
    at: Spot
    tags: list[str] = dataclasses.field(default_factory=list)


class Opaque:
    """A class of some library."""

    def __init__(self, number: int) -> None:
        self.number = number


def test_a_dataclass_is_read_by_its_fields() -> None:
    kind = value_type(Named)
    text = 'json:{"name": "dock", "at": {"x": 1, "y": 2}, "tags": ["a"], "more": 3}'
    assert kind.parse(text) == Named("dock", Spot(1.0, 2.0), ["a"])
    assert kind.name == "Place"
    known = registered(Named)
    assert known is not None
    assert known.to_json is not None
    document = known.to_json(Named("dock", Spot(1, 2)))
    assert document == {
        "name": "dock",
        "at": {"x": 1, "y": 2, "__type": "Spot"},
        "tags": [],
        "__type": "Place",
    }
    assert kind.convert(f"json:{json.dumps(document)}") == Named("dock", Spot(1, 2))
    assert registered_name("Place") is known


def test_a_text_has_its_own_form() -> None:
    kind = value_type(Spot)
    assert kind.parse("1,2") == Spot(1, 2)
    assert to_text(Spot(1, 2)) == "1,2"
    assert value_type(list[Spot]).parse('json:[{"x": 1, "y": 2}]') == [Spot(1, 2)]
    assert value_type(list[Spot]).parse("1,2;3,4") == [Spot(1, 2), Spot(3, 4)]
    assert kind.convert(Spot(3)) == Spot(3)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("json:{", "is not JSON"),
        ("json:[]", "an object is needed"),
        ('json:{"x": 1}', "field 'y' is missing"),
        ('json:{"x": "1", "y": 2}', "field 'x' takes a number, not a text"),
        ('json:{"x": [], "y": 2}', "field 'x': a value of type list"),
        ("one", "no Spot: ValueError"),
    ],
)
def test_a_text_that_is_no_value_is_refused(text: str, message: str) -> None:
    with pytest.raises(ConversionError, match=message):
        value_type(Spot).parse(text)


def test_a_value_of_another_class_is_refused() -> None:
    with pytest.raises(ConversionError, match="a whole number is not a Spot"):
        value_type(Spot).convert(3)


def test_any_class_can_be_registered_with_its_converters() -> None:
    assert registered(Opaque) is None
    register_type(Opaque, from_json=Opaque, to_json=lambda value: value.number)
    kind, known = value_type(Opaque), registered(Opaque)
    assert kind.parse("json:7").number == 7
    assert known is not None
    assert known.to_json is not None
    assert known.to_json(Opaque(7)) == 7
    with pytest.raises(ConversionError, match="a Opaque is written as json:…"):
        kind.parse("7")
    with pytest.raises(ConversionError, match="not a text"):
        to_text(Opaque(7))


def test_a_type_without_converters_has_no_literals() -> None:
    cls = register_type(type("Bare", (), {}))
    with pytest.raises(ConversionError, match="a Bare cannot be written as text"):
        value_type(cls).parse("json:{}")


def test_a_converter_that_returns_something_else_is_an_error() -> None:
    cls = register_type(type("Wrong", (), {}), from_string=int)
    with pytest.raises(ConversionError, match="the converter of Wrong returned a whole number"):
        value_type(cls).parse("7")


def test_only_classes_can_be_registered() -> None:
    thing: Any = "text"
    with pytest.raises(TypeError, match="'text' is not a class"):
        register_type(thing)
