"""Checks a document as BT.CPP does before it builds anything: tags, IDs, numbers of children, depth.

All trees of the document are checked, whether they are used or not.
"""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Final

from tree_gardener.conditions import CONDITIONS
from tree_gardener.document import NAMED_BY_ID, Document, Element
from tree_gardener.node import Kind
from tree_gardener.ports import FORBIDDEN, IDENTITY
from tree_gardener.registry import OLD_NAMES, NodeType
from tree_gardener.spelling import nearest

if TYPE_CHECKING:
    from tree_gardener.errors import Diagnostic

EXPLICIT: Final = NAMED_BY_ID - {"SubTree"}
MAX_DEPTH: Final = 256
_RESERVED: Final = IDENTITY | CONDITIONS | {"_autoremap"}
_ASYNC_IN_REACTIVE: Final = "AsyncSequence"


@dataclasses.dataclass(frozen=True)
class SubTreeModel:
    """The ports of a SubTree in the ``TreeNodesModel``; one whose default is None or empty is mandatory."""

    ports: Mapping[str, str | None]


@dataclasses.dataclass(frozen=True)
class Definition:
    """A BehaviorTree of a document."""

    tree_id: str
    document: Document
    element: Element
    subtrees: Sequence[Element] = ()
    """Its nodes that call other trees."""

    @property
    def has_id(self) -> bool:
        """Whether the document gives the tree an ID, which may be empty."""
        return "ID" in self.element.attributes

    @property
    def body(self) -> Element:
        """The root node of the tree."""
        return self.element.children[0]


def type_of(element: Element) -> str:
    """Returns the node type of an element: its tag, or the ID of the explicit form."""
    return element.attributes.get("ID", "") if element.tag in EXPLICIT else element.tag


def name_problem(name: str) -> str:
    """Returns the reason why an ID is invalid, or ""."""
    match = FORBIDDEN.search(name)
    if not name:
        return "is empty"
    if match is not None:
        return f"contains '{match.group()}', which is not allowed in an ID"
    return "is not allowed as an ID" if name in ("Root", "root") else ""


class StructureCheck:
    """Checks one document and collects its trees and models."""

    def __init__(self, document: Document, registry: Mapping[str, NodeType]) -> None:
        self.document = document
        self.registry = registry
        self.problems: list[Diagnostic] = []
        self.definitions: dict[str, Definition] = {}
        self.models: dict[str, SubTreeModel] = {}
        self.tree = ""
        self.subtrees: list[Element] = []
        self.plain = {
            name for name, kind in registry.items() if kind.max_children == 0 and name not in NAMED_BY_ID
        }
        """The tags of leaves, of which there is nothing to check if they have no children and no ID."""

    def report(self, element: Element, code: str, message: str, hint: str = "", attribute: str = "") -> None:
        """Adds a problem."""
        self.problems.append(
            self.document.diagnostic(element, code, message, hint, attribute=attribute, tree=self.tree)
        )

    def run(self) -> None:
        """Checks the document."""
        root = self.document.root
        if root.tag != "root":
            self.report(
                root, "TG201", f"the document element is <{root.tag}>, not <root>", "rename it to <root>"
            )
            return
        trees = [element for element in root.children if element.tag == "BehaviorTree"]
        models = [element for element in root.children if element.tag == "TreeNodesModel"]
        others = [element for element in root.children if element.tag not in ("Code", "Enums")]
        for element in models[1:]:
            self.report(element, "TG202", "there is more than one <TreeNodesModel>", "merge them into one")
        for element in models:
            self.check_models(element)
        for element in trees:
            self.check_tree(element, is_alone=len(others) == 1)

    def check_tree(self, element: Element, *, is_alone: bool) -> None:
        """Checks a BehaviorTree."""
        tree_id = element.attributes.get("ID")
        self.tree = tree_id or ""
        if not tree_id:
            if not is_alone:
                self.report(element, "TG203", "a <BehaviorTree> has no ID", 'name it: <BehaviorTree ID="…">')
        elif problem := name_problem(tree_id):
            self.report(
                element, "TG204", f"the ID '{tree_id}' {problem}", "use letters, digits and '_'", "ID"
            )
        elif tree_id in self.registry:
            message = f"the tree's ID '{tree_id}' is the name of a node"
            self.report(element, "TG224", message, "give the tree another ID", "ID")
        if len(element.children) != 1:
            message = (
                f"the tree '{self.tree}' has {len(element.children)} nodes at its root and needs exactly 1"
            )
            self.report(element, "TG205", message, "put them under one control node, such as a Sequence")
        self.subtrees = []
        for child in element.children:
            self.check_nodes(child)
        if element.children:
            self.definitions[self.tree] = Definition(self.tree, self.document, element, self.subtrees)
        self.tree = ""

    def check_nodes(self, top: Element) -> None:
        """Checks a node and all below it."""
        plain = self.plain
        stack = [(iter((top,)), 1)]
        while stack:
            elements, depth = stack[-1]
            for element in elements:
                if depth > MAX_DEPTH:
                    hint = "move a part into its own tree and use a SubTree"
                    self.report(element, "TG206", f"nodes are nested more than {MAX_DEPTH} deep", hint)
                    continue
                children = element.children
                if not children and element.tag in plain and "ID" not in element.attributes:
                    continue
                self.check_node(element)
                if children:
                    stack.append((iter(children), depth + 1))
                    break
            else:
                stack.pop()

    def check_node(self, element: Element) -> None:
        """Checks one node."""
        tag = element.tag
        if tag == "SubTree":
            self.check_subtree(element)
            return
        if tag in EXPLICIT:
            if "ID" not in element.attributes:
                self.report(element, "TG207", f"<{tag}> has no ID", f'say which: <{tag} ID="…">')
                return
            name = element.attributes["ID"]
        else:
            name = tag
            if "ID" in element.attributes:
                hint = f'leave it out, or use an explicit form such as <Action ID="{tag}">'
                self.report(element, "TG208", f"<{tag}> must not have an ID", hint, "ID")
        if name == "SubTree":
            self.subtrees.append(element)
        kind = self.registry.get(name)
        if kind is None:
            self.report(element, "TG209", f"there is no node '{name}'", self.suggest(name))
            return
        self.check_count(element, name, kind)
        if name == "ReactiveSequence":
            self.check_reactive(element)

    def suggest(self, name: str) -> str:
        """Returns a hint with the nearest known name."""
        if name in OLD_NAMES:
            return f"in version 4 it is {OLD_NAMES[name]}"
        near = nearest(name, self.registry)
        known = ", ".join(sorted(name for name, kind in self.registry.items() if kind.behaviour_class))
        return f"did you mean {near}?" if near else f"the actions known are: {known or 'none'}"

    def check_count(self, element: Element, name: str, kind: NodeType) -> None:
        """Checks the number of children; Switch, IfThenElse and others check theirs when they are ticked."""
        count = len(element.children)
        if not count and kind.max_children == 0:
            return
        if kind.kind is Kind.CONTROL:
            least = kind.min_children if kind.is_own else 2 if name == "TryCatch" else 1
            most = kind.max_children if kind.is_own else None
            if count < least:
                self.report(
                    element, "TG210", f"{name} has {count} children and needs {least} or more", "add some"
                )
            elif most is not None and count > most:
                message = f"{name} has {count} children and can have {most}"
                self.report(element, "TG225", message, "remove some, or put them under a Sequence")
        elif kind.kind is Kind.DECORATOR:
            if count != 1:
                hint = "put the children under a Sequence" if count else "add one"
                self.report(element, "TG211", f"{name} has {count} children and needs exactly 1", hint)
        elif count:
            hint = "actions and conditions are the ends of the branches"
            self.report(element, "TG212", f"{name} has {count} children and can have none", hint)

    def check_subtree(self, element: Element) -> None:
        """Checks a SubTree node."""
        tree_id = element.attributes.get("ID")
        if tree_id is None:
            self.report(element, "TG213", "a <SubTree> has no ID", 'say which tree: <SubTree ID="…"/>')
            return
        self.subtrees.append(element)
        if tree_id in self.registry:
            hint = "rename the tree" if tree_id in self.definitions else f"write <{tree_id}> instead"
            self.report(element, "TG214", f"the SubTree's ID '{tree_id}' is the name of a node", hint, "ID")
        if element.children:
            self.report(
                element, "TG212", "a SubTree can have no children here", f"put them into tree '{tree_id}'"
            )

    def check_reactive(self, element: Element) -> None:
        """Checks the children of a ReactiveSequence by their tags, as BT.CPP."""
        asynchronous = 0
        for child in element.children:
            if child.tag in EXPLICIT:
                name = child.attributes.get("ID", "")
                message = f'under a ReactiveSequence BehaviorTree.CPP does not take <{child.tag} ID="{name}">'
                self.report(child, "TG215", message, f"write <{name}>")
            asynchronous += child.tag == _ASYNC_IN_REACTIVE
        if asynchronous > 1:
            hint = "use a Sequence for one of them"
            self.report(element, "TG216", "a ReactiveSequence can have one AsyncSequence only", hint)

    def check_models(self, models: Element) -> None:
        """Reads the models of SubTrees; those of other nodes are in the code."""
        for element in models.children:
            if element.tag != "SubTree":
                continue
            tree_id = element.attributes.get("ID")
            if tree_id is None:
                self.report(element, "TG217", "the model of a SubTree has no ID", 'write <SubTree ID="…">')
                continue
            ports: dict[str, str | None] = {}
            for port in self.model_ports(element):
                ports[port.attributes["name"]] = port.attributes.get("default")
            self.models[tree_id] = SubTreeModel(ports)

    def model_ports(self, element: Element) -> Iterator[Element]:
        """Yields the ports of a model that have valid names."""
        for port in element.children:
            if port.tag not in ("input_port", "output_port", "inout_port"):
                continue
            name = port.attributes.get("name", "")
            if not name:
                self.report(port, "TG218", f"an <{port.tag}> has no name", 'write name="…"')
            elif name[0] in "0123456789" or name in _RESERVED or FORBIDDEN.search(name):
                reason = "is reserved" if name in _RESERVED else "cannot be used"
                hint = "begin with a letter; use letters, digits and '_'"
                self.report(port, "TG219", f"the name '{name}' of a port {reason}", hint, "name")
            else:
                yield port
