"""The source of a node of Nav2, as a ROS distribution has it; the engine has that of the newest."""

from __future__ import annotations

import ast
import re
from functools import cache
from typing import TYPE_CHECKING, Any, Final, cast

from translator.nav2.distributions import NEWEST, new_node, new_port, titled
from translator.nav2.tables import table
from translator.python_source import parse

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from translator.nav2.distributions import Distribution

TYPES: Final = {
    "double": "double",
    "float": "double",
    "bool": "bool",
    "string": "string",
    "int": "int",
    "uint16": "int",
    "unsigned int": "int",
    "chrono::milliseconds": "int",
    "vector<int>": "list[int]",
    "vector<string>": "list[string]",
}
"""The type of a port here, by its type in C++; `any` for the others."""
_IMPORT: Final = "from tree_gardener.ports import Port\n"
_CLASSES: Final = {"double": "float", "bool": "bool", "string": "str", "int": "int"}
_GROUPS: Final = {"input": "INPUT_PORTS", "output": "OUTPUT_PORTS", "inout": "INOUT_PORTS"}
_CHANGED: Final = {
    "RoundRobin": (
        ("import ControlNode, Port, PortError, Status", "import ControlNode, Status"),
        (
            "After a child that fails or is skipped, the next one is ticked in the same tick. Without "
            "`wrap_around` the\n    last child ends the round: the node fails, whatever that child returned, "
            "and starts again at the first.\n",
            "After a child that fails or is skipped, the next one is ticked in the same tick. The first "
            "follows the last.\n",
        ),
        ("self.wraps: bool | None = None", "self.wraps = True"),
        (
            "        if self.wraps is None:  # Nav2 reads it once\n            try:\n"
            '                self.wraps = self.get_input("wrap_around")\n'
            "            except PortError:\n                self.wraps = False\n",
            "",
        ),
    ),
    "TruncatePathLocal": (
        ("(path.header.frame_id)", '(path.header.frame_id, str(input_or(self, "robot_frame", "")))'),
    ),
}
"""What a node did otherwise before the newest distribution, beside its ports: texts, and those before.

Rule: Nav2's plugins/control/round_robin_node.cpp in the branches humble, jazzy and kilted.
"""


@cache
def nav2_source(type_: str, distribution: Distribution = NEWEST) -> str | None:
    """Returns the source of a node, to be `actions/<Name>.py`; None if the distribution has no such node."""
    from tree_gardener.nav2_library import source_of  # noqa: PLC0415 - the engine loads py_trees

    row = table(distribution).get(type_)
    newest = new_node(type_)
    text = source_of(newest) if row is not None else None
    if text is None or row is None or distribution == NEWEST:
        return text
    found = _as_before(text, newest, row)
    return (
        text if found == text else found.replace(' of Nav2."""', f' of Nav2 in {titled(distribution)}."""', 1)
    )


@cache
def sources(type_: str) -> frozenset[str]:
    """Returns the sources of a node in all distributions that have it, without blanks around them."""
    from translator.nav2.distributions import DISTRIBUTIONS  # noqa: PLC0415 - only here

    return frozenset(text.strip() for each in DISTRIBUTIONS if (text := nav2_source(type_, each)) is not None)


def _as_before(text: str, newest: str, row: Mapping[str, Any]) -> str:
    """Returns a source with the name, the ports and the defaults that a row says."""
    type_ = row["type"]
    for now, before in _CHANGED.get(newest, ()):
        text = text.replace(now, before)
    for port in row["ports"]:
        if (name := new_port(type_, port["name"])) != port["name"]:
            text = text.replace(f'"{name}"', f'"{port["name"]}"')
    text = text.replace(f"class {newest}(", f"class {type_}(").replace(f'"""{newest} of', f'"""{type_} of', 1)
    lines = text.splitlines(keepends=True)
    for begin, end, replacement in sorted(_edits(text, row), reverse=True):
        lines[begin:end] = replacement
    text = "".join(lines)
    return text if "Port(" in text else text.replace(_IMPORT, "").replace(" Port,", "", 1)


def _edits(text: str, row: Mapping[str, Any]) -> Iterator[tuple[int, int, list[str]]]:
    """Yields the first line, the line after the last, and the lines in their place, counted from 0."""
    wanted = {port["name"]: port for port in row["ports"]}
    body = next(
        each
        for each in parse(text, row["type"]).body
        if isinstance(each, ast.ClassDef) and each.name == row["type"]
    )
    groups = {
        target.id: statement
        for statement in body.body
        if isinstance(statement, ast.Assign)
        for target in statement.targets
        if isinstance(target, ast.Name)
    }
    for direction, group in _GROUPS.items():
        ports = {name: port for name, port in wanted.items() if port["direction"] == direction}
        if group not in groups:
            if ports:
                at = body.body[0].end_lineno or 0
                yield at, at, ["\n", f"    {group} = {{\n", *map(_declared, ports.values()), "    }\n"]
            continue
        yield from _of_group(groups[group], ports)


def _of_group(
    statement: ast.Assign, ports: Mapping[str, Mapping[str, str]]
) -> Iterator[tuple[int, int, list[str]]]:
    declared = cast("ast.Dict", statement.value)
    there = {}
    for key, value in zip(declared.keys, declared.values, strict=True):
        port, call = cast("ast.Constant", key), cast("ast.Call", value)
        there[str(port.value)] = (port.lineno - 1, call.end_lineno or 0, call)
    if not ports:
        yield statement.lineno - 1, statement.end_lineno or 0, []
        return
    for name, (begin, end, value) in there.items():
        if name not in ports:
            yield begin, end, []
        elif _default_of(value) != ports[name].get("default"):
            yield begin, end, [_declared(ports[name])]
    added = [_declared(port) for name, port in ports.items() if name not in there]
    at = (statement.end_lineno or 0) - 1
    yield at, at, added


def _default_of(call: ast.Call) -> str | None:
    return next((str(ast.literal_eval(each.value)) for each in call.keywords if each.arg == "default"), None)


def _declared(port: Mapping[str, str]) -> str:
    """Returns the line that declares a port."""
    class_ = _CLASSES.get(TYPES.get(port["type"], ""), "")
    parts = [class_] if class_ else []
    if "default" in port:
        parts.append(f"default={_literal(port['default'], class_)}")
    parts.append(f"description={_quoted(port['description'])}")
    return f'        "{port["name"]}": Port({", ".join(parts)}),\n'


def _literal(default: str, class_: str) -> str:
    if class_ == "bool":
        return default.capitalize()
    if class_ in {"int", "float"} and re.fullmatch(r"-?\d+(\.\d+)?", default):
        return default
    return _quoted(default)


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
