"""The ports that an action's class declares, read from its syntax tree.

A class declares ports in the attributes `INPUT_PORTS`, `OUTPUT_PORTS` and `INOUT_PORTS`: each is a dict of
name to `Port(…)` of tree_gardener or `PortInformation(…)` of py_trees. Of a class without them, the ports
that its code uses by a literal name are listed, so that the editor can offer them.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from translator.catalog import PortModel
from translator.text import is_xml_name

ATTRIBUTES = {"INPUT_PORTS": "input", "OUTPUT_PORTS": "output", "INOUT_PORTS": "inout"}
TYPES = {
    "int": "int",
    "float": "double",
    "double": "double",
    "str": "string",
    "string": "string",
    "bool": "bool",
    "Any": "any",
    "any": "any",
    "AnyTypeAllowed": "any",
    "object": "any",
}
_LISTS = ("list", "deque", "SharedQueue")
POSITIONAL = {
    "Port": ("type", "default", "required", "description"),
    "PortInformation": ("data_type", "required", "description", "default_value"),
}
RESERVED = frozenset(("name", "ID"))
Report = Callable[..., None]


_FORBIDDEN = frozenset("/\\:*?|.<>&\"'")


def is_port_name(name: str) -> bool:
    """Returns whether a class can declare this port: as an attribute of XML, it means nothing else."""
    return name not in RESERVED and not name.startswith("_") and is_xml_name(name)


def is_read_as_port(name: str) -> bool:
    """Returns whether the engine reads an attribute as a port that no class declares; it ignores others."""
    is_plain = name[:1].isascii() and name[:1].isalpha() and not _FORBIDDEN.intersection(name)
    return is_plain and is_port_name(name)


@dataclass(frozen=True, slots=True)
class Declarations:
    """The port dicts of a class, by attribute; those of a derived class come before those of its bases."""

    values: tuple[tuple[str, ast.expr], ...]

    @property
    def any(self) -> bool:
        """Whether the class declares any ports."""
        return bool(self.values)

    @staticmethod
    def collect(lineage: Iterable[ast.ClassDef]) -> Declarations:
        """Finds the assignment of each attribute that counts."""
        line = list(lineage)
        found = ((name, assignments(line, name)) for name in ATTRIBUTES)
        return Declarations(tuple((name, each[-1][1]) for name, each in found if each))


def declared_ports(declarations: Declarations, report: Report) -> tuple[PortModel, ...]:
    """Returns the declared ports; reports those that cannot be read without running the code."""
    ports: dict[str, PortModel] = {}
    for attribute, value in declarations.values:
        if not isinstance(value, ast.Dict):
            if not _is_empty_call(value):
                report("BT0610", value, attribute=attribute)
            continue
        for key, item in zip(value.keys, value.values, strict=True):
            if not isinstance(key, ast.Constant) or not isinstance(key.value, str):
                report("BT0610", key or item, attribute=attribute)
                continue
            if not is_port_name(key.value):
                report("BT0209", key, port=key.value)
                continue
            ports[key.value] = _port(key.value, ATTRIBUTES[attribute], item, report)
    return tuple(ports.values())


def _port(name: str, direction: str, value: ast.expr, report: Report) -> PortModel:
    if not isinstance(value, ast.Call):
        report("BT0611", value, port=name)
        return PortModel(name, direction)
    function = last_name(value.func)
    if function not in POSITIONAL:
        report("BT0611", value, port=name)
        return PortModel(name, direction)
    arguments = dict(zip(POSITIONAL[function], value.args, strict=False))
    arguments.update({keyword.arg: keyword.value for keyword in value.keywords if keyword.arg})
    annotation = arguments.get("type") or arguments.get("data_type")
    type_name = _type(annotation)
    named = _constant(annotation) if type_name == "any" else None
    default = _default(arguments.get("default") or arguments.get("default_value"))
    required = _constant(arguments.get("required"))
    if required is None:
        required = function == "PortInformation" and direction == "input"
    description = _constant(arguments.get("description"))
    if type_name is None:
        report("BT0612", value, port=name)
    return PortModel(
        name=name,
        direction=direction,
        type=type_name or "any",
        default=default,
        required=required is True and default is None,
        description=description if isinstance(description, str) else "",
        named=named if isinstance(named, str) else "",
        is_object=_is_class(annotation),
    )


def _type(node: ast.expr | None) -> str | None:
    """Returns the catalogue's name of a type; `any` if no type is given, None if it is unknown."""
    if node is None:
        return "any"
    if isinstance(node, ast.Constant):
        if node.value is None:
            return "any"
        return _type_name(node.value) if isinstance(node.value, str) else None
    return _type_name(ast.unparse(node))


def _type_name(text: str) -> str | None:
    text = text.strip().removeprefix("typing.").replace("List[", "list[")
    if text in TYPES:
        return TYPES[text]
    text = text.removeprefix("tree_gardener.").removeprefix("collections.")
    if text == "list":
        return "any"
    opening = next((name for name in _LISTS if text.startswith(f"{name}[")), "")
    if opening and text.endswith("]"):
        inner = TYPES.get(text[len(opening) + 1 : -1].strip())
        return f"list[{inner}]" if inner and inner != "any" else "any"
    # A class that the action defines: its values are passed over the blackboard by reference.
    return "any" if text.replace(".", "").replace("_", "").isalnum() else None


def _is_class(node: ast.expr | None) -> bool:
    """Returns whether a type is a class that no catalogue knows, whose literals are in JSON if it has any."""
    if not isinstance(node, ast.Name | ast.Attribute):
        return False
    text = ast.unparse(node).removeprefix("typing.")
    return text not in TYPES and last_name(node) not in _LISTS


def _default(node: ast.expr | None) -> str | None:
    """Returns the text of a default in the form of XML."""
    if node is None:
        return None
    try:
        value = ast.literal_eval(node)
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return None
    return _as_port_text(value)


def _as_port_text(value: object) -> str | None:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, int) and abs(value) < 10**30:
        return str(value)
    if isinstance(value, float) and math.isfinite(value):
        return repr(value)
    if isinstance(value, list | tuple):
        parts = [_as_port_text(item) for item in value]
        return ";".join(part for part in parts if part is not None)
    return None


def last_name(node: ast.expr) -> str:
    """Returns `c` of `a.b.c`, and "" for an expression that is not a name."""
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""


def _constant(node: ast.expr | None) -> object:
    return node.value if isinstance(node, ast.Constant) else None


def assigned(node: ast.stmt, name: str) -> ast.expr | None:
    """Returns the value that a statement assigns to a name, or None if it assigns none."""
    if isinstance(node, ast.Assign):
        if any(isinstance(target, ast.Name) and target.id == name for target in node.targets):
            return node.value
    elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.target.id == name:
        return node.value
    return None


def assignments(lineage: Iterable[ast.ClassDef], name: str) -> list[tuple[ast.stmt, ast.expr]]:
    """Returns the assignments of an attribute in the nearest class that has one; the last one counts."""
    for cls in lineage:
        found = [(node, value) for node in cls.body if (value := assigned(node, name)) is not None]
        if found:
            return found
    return []


def loop_ports(lineage: Iterable[ast.ClassDef]) -> tuple[PortModel, ...]:
    """Returns the ports of a LoopNode; its `ELEMENT` is the type of the elements."""
    elements = assignments(lineage, "ELEMENT")
    element = _type(elements[-1][1] if elements else None) or "any"
    queue = f"list[{element}]" if element != "any" and not element.startswith("list") else "any"
    return (
        PortModel("queue", "inout", queue, required=True, description="A queue of the blackboard."),
        PortModel("value", "output", element, description="Where the element goes."),
        PortModel("if_empty", "input", "status", "SUCCESS", description="The result when it is empty."),
    )


def _is_empty_call(value: ast.expr) -> bool:
    return isinstance(value, ast.Call) and last_name(value.func) == "dict" and not value.keywords


def ports_used(cls: ast.ClassDef) -> tuple[PortModel, ...]:
    """Returns the ports that the code of a class without declarations uses by name."""
    written: set[str] = set()
    names: dict[str, None] = {}
    for node in ast.walk(cls):
        if isinstance(node, ast.Call):
            function = last_name(node.func)
            if function == "set_port_content" and node.args and (name := _port_key(node.args[0])):
                written.add(name)
            elif function in {"get_input", "set_output"} and node.args:
                texts = (_constant(argument) for argument in node.args[:2])
                asked = next((text for text in texts if isinstance(text, str)), None)
                if asked is not None:
                    names.setdefault(asked)
                    if function == "set_output":
                        written.add(asked)
        if isinstance(node, ast.expr) and (name := _port_key(node)):
            names.setdefault(name)
    return tuple(PortModel(name, "output" if name in written else "input") for name in names)


def _port_key(node: ast.expr) -> str | None:
    """Returns `x` of `self.ports["x"]`, `ports["x"]` and `self.ports.get("x", …)`."""
    if isinstance(node, ast.Subscript):
        holder, key = node.value, node.slice
    elif (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and node.func.attr == "get"
        and node.args
    ):
        holder, key = node.func.value, node.args[0]
    else:
        return None
    is_ports = (isinstance(holder, ast.Attribute) and holder.attr == "ports") or (
        isinstance(holder, ast.Name) and holder.id == "ports"
    )
    value = _constant(key)
    return value if is_ports and isinstance(value, str) else None
