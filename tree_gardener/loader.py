"""Builds the nodes of a tree from checked documents.

Nodes are made in pre-order, each SubTree node before its body, without recursion. Meanwhile the ports declare
entries on the blackboard, as in BehaviorTree.CPP, so that contradictory types are found before the first
tick.
"""

import logging
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.blackboard import EMPTY, Blackboard, Entry
from tree_gardener.conditions import CONDITIONS, Guard, compile_conditions
from tree_gardener.controls.custom import CustomControl
from tree_gardener.decorators.loop import Loop
from tree_gardener.document import Element
from tree_gardener.errors import Diagnostic, ScriptError, describe, raised_at
from tree_gardener.forest import Forest
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.leaves.test_node import TestConfig, TestNode
from tree_gardener.node import NO_PORTS, Instance, Node
from tree_gardener.port_checks import PortProblem, check_text, declare_entry, script_problem
from tree_gardener.ports import IDENTITY, NO_DEFAULT, BoundPorts, Manifest, pointer_key
from tree_gardener.rebind import rebind
from tree_gardener.registry import NodeType
from tree_gardener.script import Environment, compile_script
from tree_gardener.structure import Definition, type_of
from tree_gardener.substitution import Rule
from tree_gardener.values import (
    DOUBLE,
    INT,
    INT32,
    INT64,
    INT_64,
    ConversionError,
    ValueType,
    parse_bool,
)

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

MAX_PROBLEMS: Final = 100
_INTEGER = re.compile(r"-?[0-9]+\Z")
_REAL = re.compile(r"-?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?\Z")
_LOG = logging.getLogger(__name__)


class Builder:
    """Instantiates one tree."""

    def __init__(
        self, tree: "Tree", forest: Forest, registry: Mapping[str, NodeType], rules: tuple[Rule, ...]
    ) -> None:
        self.tree = tree
        self.forest = forest
        self.registry = registry
        self.rules = rules
        self.problems: list[Diagnostic] = []
        self.nodes: list[Node] = []
        self.boards: list[Blackboard] = [tree.blackboard]
        self.definition: Definition
        self.paths = {""}  # of the SubTrees; that of the main tree is empty
        self.depths: list[int] = []

    def report(  # noqa: PLR0913 - one diagnostic
        self,
        element: Element,
        code: str,
        message: str,
        hint: str = "",
        attribute: str = "",
        span_start: int = 0,
    ) -> None:
        """Adds a problem of the tree that is being built."""
        self.problems.append(
            self.definition.document.diagnostic(
                *(element, code, message, hint),
                attribute=attribute,
                span_start=span_start,
                tree=self.definition.tree_id,
            )
        )

    def build(self, main: Definition) -> list[Node]:
        """Makes all nodes of the tree, in pre-order; adds errors to `problems`."""
        instance = Instance(main.tree_id, self.tree.blackboard, None)
        stack: list[tuple[Definition, Element, Instance, Node | None, int]] = [
            (main, main.body, instance, None, 1)
        ]
        children: dict[int, list[Node]] = {}
        while stack and len(self.problems) < MAX_PROBLEMS:
            definition, element, instance, parent, depth = stack.pop()
            self.definition = definition
            node = self.make(element, instance, parent)
            if parent is not None:
                children.setdefault(parent.uid, []).append(node)
            self.depths.append(depth)
            if element.tag == "SubTree" and not isinstance(node, TestNode):
                target = self.forest.definitions[element.attributes["ID"]]
                inner = Instance(target.tree_id, self.scope(node, instance), node)
                stack.append((target, target.body, inner, node, depth + 1))
            elif not isinstance(node, TestNode):
                stack.extend(
                    [(definition, child, instance, node, depth + 1) for child in reversed(element.children)]
                )
        for node in self.nodes:
            node.children = tuple(children.get(node.uid, ()))
        return self.nodes

    # -- one node -----------------------------------------------------------------------------------

    def make(self, element: Element, instance: Instance, parent: Node | None) -> Node:
        """Makes one node."""
        attributes = element.attributes
        kind = self.registry[type_of(element)]
        uid = len(self.nodes) + 1
        name = attributes.get(
            "name", attributes.get("ID", kind.name) if element.tag == "SubTree" else kind.name
        )
        config = None
        type_name = kind.name
        if self.rules:
            kind, config = self.substituted(element, kind, name, instance, uid)
        ports = self.ports(element, kind) if element.tag != "SubTree" else NO_PORTS
        node = kind.node_class(type_name, name, kind.manifest, ports)
        node.uid = uid
        node.element = element
        node.instance = instance
        node.board = instance.board
        node.tree = self.tree
        node.parent = parent
        self.nodes.append(node)
        if config is not None:
            assert isinstance(node, TestNode)
            node.config = config
        if ports:
            self.declare(element, kind, instance.board)
        for attribute in attributes:
            if attribute in CONDITIONS:
                self.guard(node)
                break
        if node.NEEDS:
            self.construct(node)
        if isinstance(node, (BehaviourLeaf, CustomControl)):
            self.bind(node, kind)
        return node

    def substituted(
        self, element: Element, kind: NodeType, name: str, instance: Instance, uid: int
    ) -> tuple[NodeType, TestConfig | None]:
        """Returns the node's type after substitution; for a TestNode also its configuration."""
        prefix = instance.path()
        local = name if "name" in element.attributes else f"{type_of(element)}::{uid}"
        path = f"{prefix}/{local}" if prefix else local
        for rule in self.rules:
            if not rule.matches(name, kind.name, path):
                continue
            if rule.config is not None:
                return self.registry["TestNode"], rule.config
            if rule.type in self.registry:
                return self.registry[rule.type], None
            self.report(
                element, "TG603", f"the substitution rule '{rule.pattern}' names no node: '{rule.type}'"
            )
        return kind, None

    def ports(self, element: Element, kind: NodeType) -> Mapping[str, str]:
        """Returns the ports that the document gives a node, and the textual defaults of the others."""
        manifest = kind.manifest
        if manifest is None:
            return {
                name: value
                for name, value in element.attributes.items()
                if name[0].isalpha() and name not in IDENTITY
            }
        given = {}
        for name, value in element.attributes.items():
            if name[0] == "_" or name in IDENTITY:
                continue
            spec = manifest.get(name)
            if spec is not None:
                given[name] = value
                self.found(element, name, check_text(kind.node_class, spec, value))
            elif kind.name != "TestNode" and name[0].isalpha():
                known = ", ".join(manifest) or "it has none"
                self.report(
                    element, "TG301", f"{kind.name} has no port '{name}'", f"its ports: {known}", name
                )
        for spec in manifest.values():
            if spec.required and spec.name not in given and spec.default is NO_DEFAULT:
                hint = f'write {spec.name}="…"'
                self.report(element, "TG302", f"the port '{spec.name}' of {kind.name} needs a value", hint)
        return given or NO_PORTS

    def found(self, element: Element, attribute: str, problem: PortProblem | None) -> None:
        """Adds a problem of an attribute, if there is one."""
        if problem is not None:
            code, message, hint, span_start = problem
            self.report(element, code, message, hint, attribute, span_start)

    def construct(self, node: Node) -> None:
        """Reports a missing value that BehaviorTree.CPP's constructor of the node requires."""
        port, element = node.NEEDS, node.element
        given = node.ports.get(port)
        if given is None or (not given and not node.CODE and not isinstance(node, Loop)):
            hint = f'write {port}="…"'
            self.report(element, "TG302", f"the port '{port}' of {node.type} needs a value", hint, port)
        elif node.CODE and (key := pointer_key(given, port)) is not None:
            entry = node.board.find(key)
            if entry is None or entry.value is EMPTY:
                message = (
                    f"the script of {node.type} is read when the tree is built, and '{key}' has no value then"
                )
                hint = "write the script itself, or give it to the SubTree as a constant"
                self.report(element, "TG307", message, hint, port)
            elif isinstance(entry.value, str) and entry.value:
                try:
                    compile_script(entry.value)
                except ScriptError as error:
                    message = f"in the script that '{key}' holds: {error.message}"
                    self.report(element, "TG401", message, error.hint, port)

    def declare(self, element: Element, kind: NodeType, board: Blackboard) -> None:
        """Declares the entries that the ports lead to, and compares their types."""
        manifest: Manifest | None = kind.manifest
        if manifest is None:
            return
        for name, text in element.attributes.items():
            spec = manifest.get(name)
            if spec is not None:
                self.found(element, name, declare_entry(kind.node_class, spec, text, board))

    def guard(self, node: Node) -> None:
        """Compiles the node's conditions."""
        try:
            scripts = compile_conditions(node.element.attributes)
        except ScriptError:
            for attribute, text in node.element.attributes.items():
                if attribute not in CONDITIONS:
                    continue
                try:
                    compile_script(text)
                except ScriptError as error:
                    self.found(node.element, attribute, script_problem(attribute, error))
            return
        node.guard = Guard(scripts, Environment(node.board, self.tree.enums, node.uid))

    def bind(self, node: BehaviourLeaf | CustomControl, kind: NodeType) -> None:
        """Makes the behaviour of an action, or the object of a control node."""
        assert kind.behaviour_class is not None
        try:
            if kind.takes_ports:
                node.bound = BoundPorts(bound_ports(node))
                behaviour = kind.behaviour_class(node.name, ports=node.bound)
            else:
                behaviour = kind.behaviour_class(node.name)
            behaviour.tree_gardener_node = node
            node.bind(behaviour)
            rebind(behaviour)
            node.note_early_reads()
        except (Exception, SystemExit) as error:
            _LOG.debug("the action %s cannot be made", kind.name, exc_info=True)
            hint = "look at its __init__: it is called with the node's name"
            file, line = raised_at(error)
            place = f" at {file}:{line}" if file else ""
            self.report(node.element, "TG604", f"{kind.name} cannot be made: {describe(error)}{place}", hint)

    # -- SubTrees -----------------------------------------------------------------------------------

    def scope(self, node: Node, instance: Instance) -> Blackboard:
        """Makes the blackboard for the tree that a SubTree node calls."""
        element = node.element
        path = node.path
        if path in self.paths:
            name = element.attributes.get("name", "")
            message = f"two SubTrees here are named '{name}'" if path else "the SubTree's name is empty"
            self.report(element, "TG501", message, "give each its own name, or none", "name")
        self.paths.add(path)
        board = instance.board.child()
        board.locate = lambda: node.path
        self.boards.append(board)
        board.autoremap = self.autoremap(element)
        for port, text in self.remapping(element, autoremap=board.autoremap).items():
            key_outside = pointer_key(text, port)
            if key_outside is not None:
                board.remapping[port] = key_outside
            else:
                value, kind = constant(text)
                entry = board.entries[port] = Entry(board, port, kind)
                entry.write(value)
        return board

    def autoremap(self, element: Element) -> bool:
        """Returns whether a SubTree's unconnected names mean the caller's entries (`_autoremap`)."""
        text = element.attributes.get("_autoremap")
        if text is None:
            return False
        try:
            return parse_bool(text)
        except ConversionError as error:
            self.report(element, "TG502", f"_autoremap: {error}", 'write _autoremap="true"', "_autoremap")
            return False

    def remapping(self, element: Element, *, autoremap: bool) -> dict[str, str]:
        """Returns the SubTree's ports, with the defaults of its model."""
        given = {
            name: text for name, text in element.attributes.items() if name[0] != "_" and name not in IDENTITY
        }
        model = self.forest.models.get(element.attributes["ID"])
        if model is None or autoremap:
            return given
        for name, default in model.ports.items():
            if name in given:
                continue
            if default is None:
                message = f"the SubTree '{element.attributes['ID']}' needs a value for its port '{name}'"
                self.report(
                    element, "TG503", message, f'write {name}="…", or give it a default in TreeNodesModel'
                )
            else:
                given[name] = default
        return given


def constant(text: str) -> tuple[Any, ValueType | None]:
    """Returns the value of a constant for a SubTree, with its type.

    None for a text, whose entry has no type.
    """
    if _INTEGER.match(text):
        number = int(text)
        if INT64[0] <= number <= INT64[1]:
            return number, INT if INT32[0] <= number <= INT32[1] else INT_64
    if _REAL.match(text):
        return float(text), DOUBLE
    return text, None


class PortText(str):
    """The text of a port in the form of the older contract of actions.

    It stores the scope to which it belongs.
    """

    __slots__ = ("board", "port", "writer")

    board: Blackboard
    port: str
    writer: int


def bound_ports(node: Node) -> dict[str, str]:
    """Returns the texts of a node's ports as the ``ports`` argument of an action's constructor holds them."""
    texts = {
        spec.name: str(spec.default)
        for spec in (node.manifest or {}).values()
        if spec.default is not NO_DEFAULT
    }
    texts.update(node.ports)
    ports: dict[str, str] = {}
    for name, text in texts.items():
        bound = PortText(text)
        bound.board, bound.port, bound.writer = node.board, name, node.uid
        ports[name] = bound
    return ports
