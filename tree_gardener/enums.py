"""Enumerations: names of whole numbers, for scripts and for ports.

As in BehaviorTree.CPP, scripts see the names of all enumerations at once. A port of an enumeration, declared
as ``Port("Color")``, takes its names and whole numbers, and carries the number.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from tree_gardener.errors import Diagnostic, LoadError
from tree_gardener.values import INT, INT32, ConversionError, ValueType

if TYPE_CHECKING:
    from tree_gardener.document import Document, Element

Enums = Mapping[str, "int | Mapping[str, int]"]
"""Constants by name, and enumerations by name."""


def constants(enums: Enums) -> dict[str, int]:
    """Returns the constants that scripts see.

    Raises:
        LoadError: two enumerations give a name different numbers.
    """
    found: dict[str, int] = {}
    for name, value in enums.items():
        for constant, number in value.items() if isinstance(value, Mapping) else ((name, value),):
            if found.setdefault(constant, number) != number:
                message = f"the constant '{constant}' is {found[constant]} and {number}"
                raise LoadError([Diagnostic("TG605", message, "give one of them another name")])
    return found


def types(enums: Enums) -> dict[str, ValueType]:
    """Returns the types of ports that the enumerations are."""
    return {name: _type(name, value) for name, value in enums.items() if isinstance(value, Mapping)}


def _type(name: str, members: Mapping[str, int]) -> ValueType:
    def parse(text: str) -> int:
        number = members.get(text)
        if number is not None:
            return number
        try:
            return int(INT.parse(text))
        except ConversionError:
            raise ConversionError(f"'{text}' is not one of {', '.join(members)}") from None

    def convert(value: object) -> int:
        return parse(value) if isinstance(value, str) else int(INT.convert(value))

    return ValueType(name, parse, convert)


def read_enums(document: "Document") -> dict[str, dict[str, int]]:
    """Returns the enumerations that a self-contained document brings in ``<Enums>``.

    Raises:
        LoadError: an element is not an enumeration.
    """
    found: dict[str, dict[str, int]] = {}
    for element in document.root.children:
        if element.tag == "Enums":
            for item in element.children:
                members = {value.attributes.get("name", ""): value for value in item.children}
                numbers = {name: _number(document, value) for name, value in members.items()}
                found[item.attributes.get("name", "")] = numbers
    return found


def _number(document: "Document", element: "Element") -> int:
    text = element.attributes.get("value", "")
    try:
        return int(INT.parse(text))
    except ConversionError:
        hint = f"write a whole number, {INT32[0]} to {INT32[1]}"
        message = f"'{text}' is no number of an enumeration"
        raise LoadError([document.diagnostic(element, "TG605", message, hint, attribute="value")]) from None
