"""The nodes of a project as classes of BehaviorTree.CPP: base, ports with types, docstring."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from translator.action_kind import qualified_bases
from translator.catalog import PortModel, builtins
from translator.cpp.names import class_name, file_name, identifier, literal, unique
from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.python_source import parse
from translator.text import is_xml_name
from translator.tree import CONDITIONS, pointer
from translator.values import choices, type_label
from translator.xml.write import cpp_type

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from translator.action import ActionModel
    from translator.project import Project

ANY = "BT::AnyTypeAllowed"
BASES = {
    "sync": ("SyncActionNode", "action_node.h"),
    "stateful": ("StatefulActionNode", "action_node.h"),
    "condition": ("ConditionNode", "condition_node.h"),
    "control": ("ControlNode", "control_node.h"),
    "decorator": ("DecoratorNode", "decorator_node.h"),
}
_KINDS = {"control", "decorator", "condition"}
_PLAIN_BASES = ("py_trees.behaviour.Behaviour", "tree_gardener.", "object", "abc.ABC")
# BehaviorTree.CPP refuses other names of ports, and these.
_PORT_NAME = re.compile(r"[A-Za-z][^\s<>&\"'/\\:*?|.\x00-\x1f\x7f]*")
_RESERVED_PORTS = {"name", "ID", *CONDITIONS}


@dataclass(frozen=True, slots=True)
class CppPort:
    """A port as C++ declares it: its entry in BehaviorTree.CPP's `TreeNodesModel`, and a comment (`note`)."""

    model: PortModel
    type: str
    variable: str
    note: str = ""

    @property
    def default(self) -> str | None:
        """The default as an expression of C++; None if there is none."""
        if self.model.default is None:
            return None
        text = literal(self.model.default)
        # For a bool, BehaviorTree.CPP would take the address of the text, which is always true.
        return f"std::string({text})" if self.type == "bool" and self.model.direction != "output" else text

    @property
    def function(self) -> str:
        """The function that makes the port."""
        return {"input": "InputPort", "output": "OutputPort", "inout": "BidirectionalPort"}[
            self.model.direction
        ]


@dataclass(frozen=True, slots=True)
class CppNode:
    """A node as a class. `left_out` are the names of ports that BehaviorTree.CPP does not take."""

    id: str
    kind: str
    form: str
    class_name: str
    file: str
    path: str
    doc: str
    children: str
    ports: tuple[CppPort, ...]
    left_out: tuple[str, ...] = ()
    line: int = 1

    @property
    def base(self) -> str:
        """The base class, without its namespace."""
        return BASES[self.form][0]

    @property
    def header(self) -> str:
        """The header of the base class."""
        return BASES[self.form][1]

    def diagnostics(self) -> Iterator[Diagnostic]:
        """Yields the features of the node that the C++ class lacks."""
        for name in self.left_out:
            place = Place(self.path, port=name, line=self.line)
            yield diagnostic("BT0930", place, name=self.id, port=name)


@dataclass(frozen=True, slots=True)
class CppEnum:
    """An enumeration, with the names in C++ and in scripts, and the numbers."""

    name: str
    class_name: str
    members: tuple[tuple[str, str, int], ...]


def cpp_enums(project: Project, taken: set[str]) -> tuple[CppEnum, ...]:
    """Returns the enumerations of `enums.json`."""
    found = []
    for name, members in sorted(project.enums.items()):
        held: set[str] = set()
        rows = tuple((unique(identifier(member), held), member, number) for member, number in members.items())
        found.append(CppEnum(name, unique(class_name(name), taken), rows))
    return tuple(found)


def cpp_nodes(project: Project, taken: set[str], enums: Iterable[CppEnum] = ()) -> tuple[CppNode, ...]:
    """Returns the project's own nodes, by name; `taken` are names of classes that are in use."""
    types = {enum.name: enum.class_name for enum in enums}
    seen = _ports_seen(project)
    files: set[str] = set()
    found = []
    for name, action in sorted(project.actions.items()):
        cls = unique(class_name(name), taken)
        file = unique(file_name(cls), files)
        declared = declared_ports(action, seen.get(name, ()))
        usable = [port for port in declared if can_be_port(port.name)]
        variables: set[str] = set()
        ports = tuple(_port(port, types, variables) for port in usable)
        found.append(
            CppNode(
                id=name,
                kind=action.kind,
                form=action.kind if action.kind in _KINDS else _form(action),
                class_name=cls,
                file=file,
                path=action.path,
                doc=action.doc,
                children=_children(action),
                ports=ports,
                left_out=tuple(port.name for port in declared if not can_be_port(port.name)),
                line=action.line,
            )
        )
    return tuple(found)


def can_be_port(name: str) -> bool:
    """Returns whether BehaviorTree.CPP, and XML, accept the name of a port."""
    return _PORT_NAME.fullmatch(name) is not None and name not in _RESERVED_PORTS and is_xml_name(name)


def declared_ports(action: ActionModel, seen: Iterable[str] = ()) -> list[PortModel]:
    """Returns the ports as C++ shows them; an action without declarations has those seen in trees, too."""
    ports = [_shown(port) for port in action.ports]
    if action.open:
        known = {port.name for port in ports}
        ports += [PortModel(name) for name in seen if name not in known]
    return ports


def _shown(port: PortModel) -> PortModel:
    """Returns a port with the type and the texts that C++ has for it."""
    type_ = "string" if port.type == "any" and (port.is_object or port.named) else port.type
    default = port.default
    if port.direction == "output" and default is not None and not _is_entry(default):
        default = None  # the default of an output is always an entry of the blackboard
    return replace(port, type=type_, default=default, description=" ".join(port.description.split()))


def _is_entry(default: str) -> bool:
    return pointer(default) is not None and default == default.strip()


def _port(port: PortModel, enums: Mapping[str, str], variables: set[str]) -> CppPort:
    type_ = cpp_type(port.type) or ANY
    note = ""
    if choices(port.type) is not None:
        type_ = enums.get(type_label(port.type), "std::string")
    elif port.is_object or port.named:
        note = f"In Python {port.named or 'an object'}: choose a type, and give it a convertFromString()."
    return CppPort(port, type_, unique(identifier(port.name), variables), note)


def _ports_seen(project: Project) -> dict[str, dict[str, None]]:
    seen: dict[str, dict[str, None]] = {}
    for _, tree in sorted(project.trees.items()):
        for node in tree.walk():
            seen.setdefault(node.type, {}).update(dict.fromkeys(node.ports))
    return seen


def _children(action: ActionModel) -> str:
    if action.kind != "control":
        return ""
    least, most = action.min_children, action.max_children
    if most is None:
        return f"{least} or more"
    return str(least) if least == most else f"{least} to {most}"


def _form(action: ActionModel) -> str:
    """Returns `sync` for an action that never returns RUNNING, else `stateful`; reads the syntax tree."""
    from tree_gardener.stubs import is_stub  # noqa: PLC0415 - the engine loads py_trees

    if is_stub(action.source):
        return "stateful"
    try:
        module = parse(action.source, action.path)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return "stateful"
    own = {node.name: node for node in module.body if isinstance(node, ast.ClassDef)}
    others = [base for base in qualified_bases(module, own.values()) if base not in own]
    runs = any(
        (isinstance(node, ast.Attribute) and node.attr == "RUNNING")
        or (isinstance(node, ast.Name) and node.id == "RUNNING")
        for node in ast.walk(module)
    )
    # A base from elsewhere may stay running without a word of it here.
    return "sync" if not runs and all(base.startswith(_PLAIN_BASES) for base in others) else "stateful"


def ros_blocks(project: Project) -> list[tuple[str, str, str, str]]:
    """Returns each block of ROS in the trees: its type, its name, its tree, and its type of interface."""
    return [
        (
            node.type,
            node.label,
            tree.id,
            next((text for name, text in sorted(node.ports.items()) if name.endswith("_type")), ""),
        )
        for _, tree in sorted(project.trees.items())
        for node in tree.walk()
        if node.type in builtins() and builtins()[node.type].group == "ros"
    ]
