"""Type stubs of ROS messages.

The classes that ROS generates declare no types, so a language server knows the names of a message's fields
but not their types. The sources contain the types as literals. They are read as syntax trees, never imported,
and written as `.pyi` packages.
"""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, Any, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

KINDS: Final = ("msg", "srv", "action")
_SCALARS: Final = {
    "boolean": "bool",
    "float": "float",
    "double": "float",
    "long double": "float",
    "octet": "bytes",
    "byte": "bytes",
    "char": "int",
    "string": "str",
    "wstring": "str",
} | {f"{sign}int{bits}": "int" for sign in ("", "u") for bits in (8, 16, 32, 64)}
# Arrays of these are an `array.array`, or one of numpy if their length is fixed (rosidl_generator_py).
_NUMBERS: Final = {"float": "float32", "double": "float64"} | {
    name: name for sign in ("", "u") for bits in (8, 16, 32, 64) for name in (f"{sign}int{bits}",)
}
_SEQUENCE: Final = re.compile(r"^sequence<(.+?)(?:, *\d+)?>$")
_ARRAY: Final = re.compile(r"^(.+)\[\d+\]$")
_TEXT: Final = re.compile(r"^(w?string)<\d+>$")
_MESSAGE: Final = re.compile(r"^(\w+)/(\w+)$")


class Interface(NamedTuple):
    """One generated class: its fields with their ROS types, its constants, and its nested classes."""

    name: str
    fields: dict[str, str]
    constants: dict[str, object]
    parts: dict[str, str]


def write_message_stubs(site_packages: Path, target: Path) -> list[str]:
    """Writes stubs of every package with ROS interfaces; returns the packages' names."""
    written = []
    for folder in sorted(site_packages.iterdir()):
        kinds = [kind for kind in KINDS if (folder / kind / "__init__.py").is_file()]
        stubs = {kind: stub_of(folder / kind) for kind in kinds}
        stubs = {kind: text for kind, text in stubs.items() if text}
        if not stubs:
            continue
        package = target / folder.name
        package.mkdir(parents=True, exist_ok=True)
        (package / "__init__.pyi").write_text("".join(f"from . import {kind} as {kind}\n" for kind in stubs))
        for kind, text in stubs.items():
            (package / kind).mkdir(exist_ok=True)
            (package / kind / "__init__.pyi").write_text(text)
        written.append(folder.name)
    return written


def stub_of(folder: Path) -> str:
    """Returns the stub of one folder of generated modules; "" if the folder has none."""
    interfaces = [each for path in sorted(folder.glob("_*.py")) for each in interfaces_of(path)]
    if not interfaces:
        return ""
    used: set[str] = set()
    bodies = [_class(each, folder.parent.name, folder.name, used) for each in interfaces]
    imports = "".join(f"import {package}.msg\n" for package in sorted(used))
    head = (
        "import array as _array\nfrom collections.abc import Iterable\nfrom typing import Any, ClassVar\n\n"
        "import numpy as _numpy\nimport numpy.typing as _typing\n"
    )
    return head + imports + "\n" + "\n".join(bodies)


def interfaces_of(path: Path) -> Iterator[Interface]:
    """Yields the classes of a generated module, in the order of the file."""
    if path.name == "__init__.py":
        return
    constants: dict[str, object] = {}
    for statement in ast.parse(path.read_text(encoding="utf-8")).body:
        if not isinstance(statement, ast.ClassDef):
            continue
        literals = _literals(statement)
        if statement.name.startswith("Metaclass_"):
            constants = literals.get("__constants", {})
            continue
        parts = {
            alias.asname: alias.name
            for each in statement.body
            if isinstance(each, ast.ImportFrom)
            for alias in each.names
            if alias.asname
        }
        fields = literals.get("_fields_and_field_types")
        if fields is not None or parts:
            yield Interface(statement.name, fields or {}, constants, parts)


def _literals(statement: ast.ClassDef) -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = {}
    for each in statement.body:
        if not isinstance(each, ast.Assign) or not isinstance(each.targets[0], ast.Name):
            continue
        if each.targets[0].id in {"__constants", "_fields_and_field_types"}:
            found[each.targets[0].id] = ast.literal_eval(each.value)
    return found


def _class(interface: Interface, package: str, kind: str, used: set[str]) -> str:
    lines = [f"class {interface.name}:", f'    """`{package}/{kind}/{interface.name}`"""']
    lines += [f"    {alias} = {name}" for alias, name in interface.parts.items()]
    lines += [
        f"    {name}: ClassVar[{type(value).__name__}] = {value!r}"
        for name, value in interface.constants.items()
    ]
    types = {name: _python_type(ros, package, used) for name, ros in interface.fields.items()}
    if not interface.parts:
        arguments = "".join(f", {name}: {given} = ..." for name, (_, given) in types.items())
        marker = ", *" if arguments else ""
        lines.append(f"    def __init__(self{marker}{arguments}) -> None: ...")
    for name, (held, given) in types.items():
        if held == given:
            lines.append(f"    {name}: {held}")
        else:
            lines += ["    @property", f"    def {name}(self) -> {held}: ...", f"    @{name}.setter"]
            lines.append(f"    def {name}(self, value: {given}) -> None: ...")
        lines.append(f'    """`{interface.fields[name]}`"""')
    return "\n".join(lines) + "\n"


def _python_type(ros: str, package: str, used: set[str]) -> tuple[str, str]:
    """Returns the type of a field for reading, and its type for assignment."""
    if sequence := _SEQUENCE.match(ros) or _ARRAY.match(ros):
        inner = _python_type(sequence[1], package, used)[0]
        held = f"list[{inner}]"
        if dtype := _NUMBERS.get(sequence[1]):
            is_fixed = _ARRAY.match(ros) is not None
            held = f"_typing.NDArray[_numpy.{dtype}]" if is_fixed else f"_array.array[{inner}]"
        return held, f"Iterable[{inner}]"
    if text := _TEXT.match(ros):
        ros = text[1]
    if ros in _SCALARS:
        return _SCALARS[ros], _SCALARS[ros]
    if message := _MESSAGE.match(ros):
        if re.search(r"_(Goal|Result|Feedback|Request|Response|Event|SendGoal|GetResult)", message[2]):
            return (message[2], message[2]) if message[1] == package else ("Any", "Any")
        used.add(message[1])
        name = f"{message[1]}.msg.{message[2]}"
        return name, name
    return "Any", "Any"
