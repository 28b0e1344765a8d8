"""TypeScript types of the native protocol, generated from `executor.messages`.

Run ``python -m executor.generate.typescript`` after a change of the messages; a test fails
otherwise.
"""

from __future__ import annotations

import argparse
import inspect
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal, get_args, get_origin

import msgspec
from msgspec import inspect as types

from executor import (
    apply_messages,
    attach_messages,
    command_messages,
    debug_messages,
    evaluation_events,
    messages,
    profile_messages,
    recording_events,
    source_events,
    stream_messages,
    topic_events,
    tree_events,
    trying_events,
)

if TYPE_CHECKING:
    from types import ModuleType

TARGET: Final = Path(__file__).parents[2] / "frontend" / "src" / "generated" / "messages.ts"

_MODULES: Final = (
    apply_messages,
    attach_messages,
    debug_messages,
    profile_messages,
    command_messages,
    evaluation_events,
    trying_events,
    source_events,
    recording_events,
    topic_events,
    tree_events,
    messages,
    stream_messages,
)

_HEADER: Final = """// Generated from executor/messages.py by `python -m executor.generate.typescript`.
// Do not edit.
"""

_SCALARS: Final[dict[type[types.Type], str]] = {
    types.AnyType: "unknown",
    types.NoneType: "null",
    types.BoolType: "boolean",
    types.IntType: "number",
    types.FloatType: "number",
    types.StrType: "string",
    types.BytesType: "Uint8Array",
    types.RawType: "unknown",
}


def generate() -> str:
    """Returns the text of the TypeScript module."""
    parts = [_HEADER, f'export const PROTOCOL = "{messages.PROTOCOL}";\n']
    parts += [_literal(name, value) for name, value in _literals().items()]
    parts += [_interface(struct) for struct in _structs()]
    parts.append(_map("Commands", messages.COMMANDS))
    parts.append(_map("Events", messages.EVENTS))
    frames = " | ".join(struct.__name__ for struct in messages.FRAMES)
    parts.append(f"/** What the stream socket sends, told by `type`. */\nexport type Frame = {frames};\n")
    return "\n".join(parts)


def _structs() -> list[type[msgspec.Struct]]:
    """Returns the message types in the order of their modules."""
    return [v for module in _MODULES for v in vars(module).values() if _is_struct_of(module, v)]


def _is_struct_of(module: ModuleType, value: object) -> bool:
    return (
        inspect.isclass(value) and issubclass(value, msgspec.Struct) and value.__module__ == module.__name__
    )


def _is_literal(value: object) -> bool:
    return get_origin(value) is Literal


def _literals() -> dict[str, object]:
    """Returns the named literal types of all message modules, by name."""
    return {name: v for module in _MODULES for name, v in vars(module).items() if _is_literal(v)}


def _literal(name: str, value: object) -> str:
    options = " | ".join(f'"{option}"' for option in get_args(value))
    return f"export type {name} = {options};\n"


def _interface(struct: type[msgspec.Struct]) -> str:
    info = types.type_info(struct)
    assert isinstance(info, types.StructType)  # noqa: S101 - narrows for mypy; every Struct is one
    if not info.fields and info.tag is None:
        return f"{_comment(struct)}\nexport type {struct.__name__} = Record<string, never>;\n"
    lines = [_comment(struct), f"export interface {struct.__name__} {{"]
    if info.tag is not None:
        lines.append(f'  {info.tag_field}: "{info.tag}";')
    lines += [_field(field, optional=_may_be_absent(struct, field)) for field in info.fields]
    return "\n".join([*lines, "}\n"])


def _may_be_absent(struct: type[msgspec.Struct], field: types.Field) -> bool:
    """Returns whether a field may be absent.

    Such a field may be UNSET, or has a default that clients or the server may omit.
    """
    if not field.required and field.default is field.default_factory:  # both NODEFAULT: it is UNSET
        return True
    from_client = struct.__name__ in _client_structs()
    return not field.required and (from_client or struct.__struct_config__.omit_defaults)


def _client_structs() -> set[str]:
    """Returns the names of the structs that clients send, with those nested in them."""
    names: set[str] = {messages.ClientMessage.__name__}
    todo: list[types.Type] = [types.type_info(struct) for struct in messages.COMMANDS.values()]
    while todo:
        item = todo.pop()
        if isinstance(item, types.StructType) and item.cls.__name__ not in names:
            names.add(item.cls.__name__)
            todo += [field.type for field in item.fields]
        elif isinstance(item, types.UnionType):
            todo += item.types
    return names


def _comment(struct: type[msgspec.Struct]) -> str:
    text = inspect.cleandoc(struct.__doc__ or "").splitlines()
    if len(text) == 1:
        return f"/** {text[0]} */"
    return "\n".join(["/**", *(f" * {line}".rstrip() for line in text), " */"])


def _field(field: types.Field, *, optional: bool) -> str:
    mark = "?" if optional else ""
    return f"  {field.encode_name}{mark}: {_type(field.type)};"


def _type(kind: types.Type) -> str:
    scalar = _SCALARS.get(type(kind))
    if scalar is not None:
        return scalar
    match kind:
        case types.LiteralType(values=values):
            named = [name for name, value in _literals().items() if set(get_args(value)) == set(values)]
            return named[0] if named else " | ".join(f'"{value}"' for value in values)
        case types.StructType(cls=struct):
            return struct.__name__
        case types.UnionType(types=options):
            names = [_type(option) for option in options]
            return "unknown" if "unknown" in names else " | ".join(names)
        case _:
            return _collection(kind)


def _collection(kind: types.Type) -> str:
    match kind:
        case types.ListType(item_type=item):
            inner = _type(item)
            return f"({inner})[]" if " | " in inner else f"{inner}[]"
        case types.TupleType(item_types=items):
            return f"[{', '.join(_type(item) for item in items)}]"
        case types.DictType(key_type=key, value_type=value):
            return f"Record<{_type(key)}, {_type(value)}>"
        case _:
            message = f"no TypeScript type for {kind!r}; add a case to executor/generate/typescript.py"
            raise TypeError(message)


def _map(name: str, table: dict[str, type[msgspec.Struct]]) -> str:
    rows = [f"  {_key(key)}: {struct.__name__};" for key, struct in table.items()]
    return "\n".join([f"/** Payload by `command`. */\nexport interface {name} {{", *rows, "}\n"])


def _key(name: str) -> str:
    return name if name.isidentifier() else f'"{name}"'


def main() -> None:
    """Writes the module, or only checks whether it is current (``--check``)."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true")
    text = generate()
    if parser.parse_args().check:
        if TARGET.read_text() != text:
            raise SystemExit(f"{TARGET.name} is stale: run python -m executor.generate.typescript")
        return
    TARGET.parent.mkdir(parents=True, exist_ok=True)
    TARGET.write_text(text)


if __name__ == "__main__":
    main()
