"""Types that users register: how their values are read from text and JSON, and written as text and JSON.

```python
@register_type(from_string=lambda text: Point(*map(float, text.split(","))))
@dataclasses.dataclass
class Point:
    x: float
    y: float
```

A port of type ``Point`` then takes ``1,2`` and ``json:{"x": 1, "y": 2}``. As in BehaviorTree.CPP, a document
holds the name of its type in ``__type`` where the type is not known from elsewhere.
"""

import dataclasses
import json
import typing
from collections.abc import Callable, Mapping
from typing import Any, Final, TypeVar, overload

from tree_gardener.type_words import type_words
from tree_gardener.values import ConversionError, ValueType, set_type, value_type, value_words

C = TypeVar("C", bound=type)

PREFIX: Final = "json:"
TYPE: Final = "__type"


@dataclasses.dataclass(frozen=True)
class Registered:
    """A registered class.

    Attributes:
        cls: the class.
        name: its name in JSON and in messages.
        kind: the type of its ports.
        to_json: makes a JSON document of a value, with the name of the type; None if it has no such form.
    """

    cls: type
    name: str
    kind: ValueType
    to_json: Callable[[Any], Any] | None


_BY_NAME: dict[str, Registered] = {}
_BY_CLASS: dict[type, Registered] = {}


@overload
def register_type(
    cls: None = None,
    *,
    name: str = ...,
    from_string: Callable[[str], Any] | None = ...,
    to_string: Callable[[Any], str] | None = ...,
    from_json: Callable[[Any], Any] | None = ...,
    to_json: Callable[[Any], Any] | None = ...,
) -> Callable[[C], C]: ...


@overload
def register_type(
    cls: C,
    *,
    name: str = ...,
    from_string: Callable[[str], Any] | None = ...,
    to_string: Callable[[Any], str] | None = ...,
    from_json: Callable[[Any], Any] | None = ...,
    to_json: Callable[[Any], Any] | None = ...,
) -> C: ...


def register_type(  # noqa: PLR0913 - the four conversions, each of them optional
    cls: Any = None,
    *,
    name: str = "",
    from_string: Callable[[str], Any] | None = None,
    to_string: Callable[[Any], str] | None = None,
    from_json: Callable[[Any], Any] | None = None,
    to_json: Callable[[Any], Any] | None = None,
) -> Any:
    """Registers a class as a type of ports and entries; also used as a decorator.

    Args:
        cls: the class. A dataclass has the forms in JSON by its fields, unless others are given.
        name: the name of the type; that of the class if empty.
        from_string: makes a value from the literal of a port, or from an entry that holds a text.
        to_string: makes the text that a string port reads.
        from_json: makes a value from a parsed JSON document, for literals ``json:…`` and imports.
        to_json: makes a document of a value, for exports.

    Raises:
        TypeError: `cls` is not a class.
    """
    forms = {"from_string": from_string, "to_string": to_string, "from_json": from_json, "to_json": to_json}
    if cls is None:
        return lambda given: register_type(given, name=name, **forms)
    if not isinstance(cls, type):
        raise TypeError(f"{cls!r} is not a class")
    called = name or cls.__qualname__
    if dataclasses.is_dataclass(cls):
        from_json = from_json or (lambda document: _from_fields(cls, document))
        to_json = to_json or _to_fields
    kind = _kind(cls, called, from_string, from_json)
    entry = Registered(cls, called, kind, _named(called, to_json) if to_json is not None else None)
    _BY_NAME[called] = _BY_CLASS[cls] = entry
    set_type(cls, kind, to_string)
    return cls


def registered(cls: type) -> Registered | None:
    """Returns the entry of a class, or None."""
    return _BY_CLASS.get(cls)


def registered_name(name: str) -> Registered | None:
    """Returns the entry of the type with this name, or None."""
    return _BY_NAME.get(name)


def _kind(
    cls: type,
    name: str,
    from_string: Callable[[str], Any] | None,
    from_json: Callable[[Any], Any] | None,
) -> ValueType:
    def read(document: Any) -> Any:
        assert from_json is not None
        return _checked(cls, name, lambda: from_json(document))

    def parse(text: str) -> Any:
        if from_json is not None and text.startswith(PREFIX):
            try:
                document = json.loads(text[len(PREFIX) :])
            except (ValueError, RecursionError) as error:
                raise ConversionError(f"'{text}' is not JSON: {error}") from None
            return read(document)
        if from_string is None:
            way = "cannot be written as text" if from_json is None else f"is written as {PREFIX}…"
            raise ConversionError(f"'{text}': a {name} {way}, or use a {{key}}")
        return _checked(cls, name, lambda: from_string(text))

    def convert(value: Any) -> Any:
        if isinstance(value, cls):
            return value
        if isinstance(value, str):
            return parse(value)
        raise ConversionError(f"{value_words(value)} is not a {name}")

    return ValueType(name, parse, convert, from_json=read if from_json is not None else None)


def _checked(cls: type, name: str, make: Callable[[], Any]) -> Any:
    """Calls a converter of the user; its errors become errors of the port."""
    try:
        value = make()
    except ConversionError:
        raise
    except Exception as error:
        raise ConversionError(f"no {name}: {type(error).__name__}: {error}") from error
    if not isinstance(value, cls):
        raise ConversionError(f"the converter of {name} returned {value_words(value)}")
    return value


def _named(name: str, to_json: Callable[[Any], Any]) -> Callable[[Any], Any]:
    def write(value: Any) -> Any:
        document = to_json(value)
        return (
            {**document, TYPE: name} if isinstance(document, Mapping) and TYPE not in document else document
        )

    return write


def _from_fields(cls: type, document: Any) -> Any:
    """Makes a dataclass from a document that holds all its fields; others are ignored."""
    if not isinstance(document, dict):
        raise ConversionError(f"an object is needed, not {json.dumps(document)[:100]}")
    hints = typing.get_type_hints(cls)
    values = {}
    for field in dataclasses.fields(cls):
        if not field.init:
            continue
        if field.name not in document:
            raise ConversionError(f"the field '{field.name}' is missing")
        values[field.name] = _field(field.name, hints[field.name], document[field.name])
    return cls(**values)


def _field(name: str, annotation: Any, document: Any) -> Any:
    kind = value_type(annotation)
    if kind.from_json is not None:
        return kind.from_json(document)
    if isinstance(document, str) and annotation is not str and kind.is_strong:
        raise ConversionError(f"the field '{name}' takes {type_words(kind.name)}, not a text")
    try:
        return kind.convert(document)
    except ConversionError as error:
        raise ConversionError(f"the field '{name}': {error}") from None


def _to_fields(value: Any) -> dict[str, Any]:
    document = {}
    for field in dataclasses.fields(value):
        held = getattr(value, field.name)
        known = registered(type(held))
        document[field.name] = (
            known.to_json(held) if known is not None and known.to_json is not None else held
        )
    return document
