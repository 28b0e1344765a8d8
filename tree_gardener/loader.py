"""Builds the nodes of a tree from checked documents.

Nodes are made in pre-order, each SubTree node before its body, without recursion. Meanwhile the ports declare
entries on the blackboard, as in BehaviorTree.CPP, so that contradictory types are found before the first
tick.
"""

import logging
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Final, cast

from tree_gardener import behaviour_ids
from tree_gardener.blackboard import EMPTY, Blackboard, Entry
from tree_gardener.conditions import CONDITIONS, Guard, compile_conditions
from tree_gardener.controls.adapted import holds_nothing
from tree_gardener.decorators.loop import Loop
from tree_gardener.decorators.subtree import SubTree
from tree_gardener.document import Element
from tree_gardener.errors import Diagnostic, ScriptError, describe, raised_at
from tree_gardener.forest import Forest
from tree_gardener.leaves.test_node import TestConfig, TestNode
from tree_gardener.node import NO_PORTS, Control, Decorator, Instance, Node
from tree_gardener.port_checks import PortProblem, check_text, declare_entry, script_problem
from tree_gardener.ports import NO_DEFAULT, BoundPorts, Manifest, entry_key, is_port_name, pointer_key
from tree_gardener.rebind import rebind
from tree_gardener.registry import NodeType
from tree_gardener.script import Environment, compile_script
from tree_gardener.structure import EXPLICIT, Definition, type_of
from tree_gardener.substitution import Rule
from tree_gardener.values import ConversionError, parse_bool, typed_constant

if TYPE_CHECKING:
    from tree_gardener.callbacks import UsersNode
    from tree_gardener.tree import Tree

MAX_PROBLEMS: Final = 100
constant: Final = typed_constant
behaviour_ids.install()
_LOG = logging.getLogger(__name__)


class _Level:
    """Elements of which nodes are to be made, below one node.

    Attributes:
        definition: their tree.
        elements: those that are left.
        instance: their instance of the tree.
        parent: the node above them; None above the root.
        depth: their depth.
        is_attached: whether they become a part of the tree. What does not is checked and has entries on the
            blackboard: it is below a leaf that replaces another node.
        made: their nodes.
    """

    __slots__ = ("definition", "depth", "elements", "instance", "is_attached", "made", "parent")

    def __init__(  # noqa: PLR0913 - all of a level
        self,
        definition: Definition,
        elements: Iterable[Element],
        instance: Instance,
        parent: Node | None,
        depth: int,
        *,
        is_attached: bool,
    ) -> None:
        self.definition = definition
        self.elements = iter(elements)
        self.instance = instance
        self.parent = parent
        self.depth = depth
        self.is_attached = is_attached
        self.made: list[Node] = []


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
        self.number = 0  # as BehaviorTree.CPP counts nodes
        self.paths = {""}  # of the SubTrees; that of the main tree is empty
        self.depth = 0

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
        stack = [_Level(main, (main.body,), instance, None, 1, is_attached=True)]
        problems, make = self.problems, self.make
        while stack and len(problems) < MAX_PROBLEMS:
            level = stack[-1]
            self.definition = level.definition
            made = level.made
            for element in level.elements:
                node = make(element, level)
                made.append(node)
                if element.children or element.tag == "SubTree":
                    if (below := self.below(element, node, level)) is not None:
                        stack.append(below)
                    break
                if len(problems) >= MAX_PROBLEMS:
                    return self.nodes
            else:
                stack.pop()
                if level.parent is not None and level.is_attached:
                    level.parent.children = tuple(made)
        if self.rules:
            for node in self.nodes:
                self.count(node)
        return self.nodes

    def count(self, node: Node) -> None:
        """Reports a node with children that replaces one whose children it cannot have."""
        exactly = isinstance(node, Decorator) and len(node.children) != 1
        if exactly or (isinstance(node, Control) and not node.children):
            message = f"a rule replaces '{node.name}' by {'a decorator' if exactly else 'a control node'}"
            needs = "exactly 1 child" if exactly else "children"
            self.report(node.element, "TG606", f"{message}, which needs {needs}", "name a leaf in the rule")

    def below(self, element: Element, node: Node, level: _Level) -> _Level | None:
        """Returns what to make below a node; below a leaf, which replaces another node, it is in no tree."""
        depth, is_attached = level.depth + 1, level.is_attached and isinstance(node, Control)
        if not isinstance(node, SubTree):
            return _Level(
                *(level.definition, element.children, level.instance, node, depth), is_attached=is_attached
            )
        target = self.forest.definitions.get(element.attributes["ID"])
        if target is None or target.tree_id in level.instance.above():
            self.problems += self.forest.check_cycles(level.definition)
            return None
        inner = Instance(target.tree_id, self.scope(node, level.instance), node)
        return _Level(target, (target.body,), inner, node, depth, is_attached=is_attached)

    def make(self, element: Element, level: _Level) -> Node:
        """Makes one node."""
        attributes, tag, instance = element.attributes, element.tag, level.instance
        kind = given = self.registry[tag if tag not in EXPLICIT else type_of(element)]
        if attributes:
            name = attributes.get("name")
            if name is None:
                name = element.type_id
        else:
            name = tag
        number = self.number = self.number + 1
        config = None
        if self.rules:
            kind, config = self.substituted(element, given, name, instance)
        # A node that replaces another has the ports, the defaults and the type of that one.
        ports = NO_PORTS
        manifest = given.manifest
        if tag == "SubTree":
            manifest = manifest if kind is given else None
        if (attributes or given.has_required) and (tag != "SubTree" or kind is not given):
            ports = self.ports(element, given, manifest, kind.node_class)
        node = kind.node_class(given.name, name, manifest, ports)
        node.element = element
        node.instance = instance
        node.board = instance.board
        node.tree = self.tree
        if level.is_attached:
            node.parent = level.parent
            self.nodes.append(node)
            node.uid = uid = len(self.nodes)
            self.depth = max(self.depth, level.depth)
        else:
            node.uid = uid = -number
        if uid != number:
            self.tree.numbers[uid] = number
        if config is not None:
            assert isinstance(node, TestNode)
            node.config = config
        if ports:
            self.declare(element, given, instance.board)
        if attributes and not CONDITIONS.isdisjoint(attributes):
            self.guard(node)
        if node.NEEDS:
            self.construct(node)
        if (behaviour_class := kind.behaviour_class) is not None:
            self.bind(cast("UsersNode", node), kind, behaviour_class)
        return node

    def substituted(
        self, element: Element, kind: NodeType, name: str, instance: Instance
    ) -> tuple[NodeType, TestConfig | None]:
        """Returns the node's type after substitution; for a TestNode also its configuration."""
        prefix = instance.path()
        local = f"{name}::{self.number}" if name == element.type_id else name
        path = f"{prefix}/{local}" if prefix else local
        for rule in self.rules:
            if not rule.matches(name, kind.name, path):
                continue
            if rule.config is not None:
                if problem := rule.config.problem:
                    self.report(
                        element, "TG603", f"the configuration of the rule '{rule.pattern}': {problem}"
                    )
                return self.registry["TestNode"], rule.config
            if rule.type in self.registry and rule.type != "SubTree":
                return self.registry[rule.type], None
            what = "a SubTree, which cannot replace another node" if rule.type == "SubTree" else "no node"
            message = f"the substitution rule '{rule.pattern}' names {what}: '{rule.type}'"
            self.report(element, "TG603", message)
        return kind, None

    def ports(
        self, element: Element, kind: NodeType, manifest: Manifest | None, node_class: type[Node]
    ) -> Mapping[str, str]:
        """Returns the ports that the document gives a node, and the textual defaults of the others."""
        if manifest is None:
            return {name: value for name, value in element.attributes.items() if is_port_name(name)}
        given = {}
        for name, value in element.attributes.items():
            spec = manifest.get(name)
            if spec is not None:
                given[name] = value
                self.found(element, name, check_text(node_class, spec, value))
            elif kind.name != "TestNode" and is_port_name(name):
                known = ", ".join(manifest) or "it has none"
                self.report(
                    element, "TG301", f"{kind.name} has no port '{name}'", f"its ports: {known}", name
                )
        for spec in manifest.values() if kind.has_required else ():
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

    def bind(self, node: "UsersNode", kind: NodeType, behaviour_class: type[Any]) -> None:
        """Makes the behaviour of an action, or the object of a control node."""
        try:
            if kind.takes_ports:
                node.bound = BoundPorts(bound_ports(node))
                behaviour = behaviour_class(node.name, ports=node.bound)
            else:
                behaviour = behaviour_class(node.name)
            behaviour.tree_gardener_node = node
            node.bind(behaviour)
            if kind.has_py_trees_ports:
                rebind(behaviour)
            if node.inputs or node.bound is not None:
                node.note_early_reads()
            if holds_nothing(behaviour, node.element.children):
                message = f"{kind.name} has 0 children and needs 1 or more"
                self.report(node.element, "TG210", message, "add some, here or in its __init__")
        except (Exception, SystemExit) as error:
            _LOG.debug("the action %s cannot be made", kind.name, exc_info=True)
            hint = "look at its __init__: it is called with the node's name"
            file, line = raised_at(error)
            place = f" at {file}:{line}" if file else ""
            self.report(node.element, "TG604", f"{kind.name} cannot be made: {describe(error)}{place}", hint)

    def scope(self, node: SubTree, instance: Instance) -> Blackboard:
        """Makes the blackboard for the tree that a SubTree node calls."""
        element = node.element
        path = node.scope
        if path in self.paths:
            name = element.attributes.get("name", "")
            message = f"two SubTrees here are named '{name}'" if path else "the SubTree's name is empty"
            self.report(element, "TG501", message, "give each its own name, or none", "name")
        self.paths.add(path)
        board = instance.board.child()
        board.locate = lambda: node.scope
        self.boards.append(board)
        board.autoremap = self.autoremap(element)
        for port, text in self.remapping(element, autoremap=board.autoremap).items():
            key_outside = entry_key(text)
            if key_outside != text:
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
            name: f"{{{name}}}" if text == "{=}" else text
            for name, text in element.attributes.items()
            if is_port_name(name)
        }
        model = self.forest.models.get(element.attributes["ID"])
        if model is None or autoremap:
            return given
        for name, default in model.ports.items():
            if name in given:
                continue
            if not default:
                message = f"the SubTree '{element.attributes['ID']}' needs a value for its port '{name}'"
                self.report(
                    element, "TG503", message, f'write {name}="…", or give it a default in TreeNodesModel'
                )
            else:
                given[name] = default
        return given


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
