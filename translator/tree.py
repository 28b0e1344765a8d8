"""The tree that every format goes through: immutable, typed, with queries and structural edits.

A `Tree` holds its nodes by id; ids are stable over edits and formats. The order of `children`
is the order of execution. Nodes that are not descendants of the root belong to `drafts`.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from translator.catalog import PortModel

SUBTREE = "SubTree"
AUTOREMAP = "_autoremap"
CONFLICTS = "_bts_conflicts"
PRE_CONDITIONS = ("_failureIf", "_successIf", "_skipIf", "_while")
POST_CONDITIONS = ("_onSuccess", "_onFailure", "_post", "_onHalted")
CONDITIONS = PRE_CONDITIONS + POST_CONDITIONS
EMPTY: Mapping[str, str] = {}
BLANKS = " "  # other whitespace belongs to the text


@dataclass(frozen=True, slots=True)
class Span:
    """Line and column (both from 1) of a node in its file."""

    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Node:
    """One node. `tree` is the target of a SubTree; `attributes` are those that only other programs use.

    `silenced` are the codes of findings that are not reported at the node, each with the reason.

    An empty name gives another path than no name (None).
    """

    id: str
    type: str
    name: str = ""
    tree: str = ""
    ports: Mapping[str, str] = field(default_factory=dict)
    conditions: Mapping[str, str] = field(default_factory=dict)
    attributes: Mapping[str, str] = field(default_factory=dict)
    children: tuple[str, ...] = ()
    position: tuple[float, float] | None = None
    comment: str = ""
    color: str = ""
    disabled: bool = False
    collapsed: bool = False
    silenced: Mapping[str, str] = field(default_factory=dict)
    has_empty_name: bool = False
    span: Span | None = field(default=None, compare=False)

    @property
    def is_subtree(self) -> bool:
        """Whether the node calls another tree."""
        return self.type == SUBTREE

    @property
    def autoremap(self) -> bool:
        """Whether a SubTree shares the names of its caller."""
        return self.attributes.get(AUTOREMAP, "").lower() in {"true", "1"}

    @property
    def label(self) -> str:
        """The node's name in messages."""
        return self.name or self.tree or self.type


@dataclass(frozen=True, slots=True)
class Tree:
    """One behaviour tree.

    `ports` are its ports as a SubTree; an empty `layout` means the default, vertical one. `conflicts` are
    those that a merge has left (`translator.merge`); XML has them in an attribute.
    """

    id: str
    root: str | None
    nodes: Mapping[str, Node]
    drafts: tuple[str, ...] = ()
    layout: str = ""
    ports: tuple[PortModel, ...] = ()
    attributes: Mapping[str, str] = field(default_factory=dict)
    file: str = field(default="", compare=False)
    conflicts: tuple[Mapping[str, Any], ...] = ()

    def walk(self, start: str | None = None) -> Iterator[Node]:
        """Yields the nodes in order of execution, from the root or from `start`; never recurses."""
        stack = [start if start is not None else self.root]
        while stack:
            node_id = stack.pop()
            if node_id is None or (node := self.nodes.get(node_id)) is None:
                continue
            yield node
            stack.extend(reversed(node.children))

    def post_order(self) -> Iterator[Node]:
        """Yields the nodes, children before parents and siblings in reverse order; drafts are left out."""
        yield from reversed(list(self.walk()))

    def parents(self) -> dict[str, str]:
        """Returns each child's parent."""
        return {child: node.id for node in self.nodes.values() for child in node.children}

    def subtree_calls(self) -> Iterator[Node]:
        """Yields the SubTree nodes of the tree, without those in drafts."""
        return (node for node in self.walk() if node.is_subtree)

    def depth(self) -> int:
        """Returns the number of levels of the tree, without drafts."""
        depths: dict[str, int] = {}
        deepest = 0
        for node in self.walk():
            level = depths.get(node.id, 1)
            deepest = max(deepest, level)
            depths.update((child, level + 1) for child in node.children)
        return deepest

    def with_node(self, node: Node) -> Tree:
        """Returns the tree with the node added or replaced; its parent is not changed."""
        return replace(self, nodes={**self.nodes, node.id: node})

    def edited(self, node_id: str, **changes: Any) -> Tree:
        """Returns the tree with fields of one node changed."""
        return self.with_node(replace(self.nodes[node_id], **changes))

    def inserted(self, node: Node, *, parent: str, index: int | None = None) -> Tree:
        """Returns the tree with a new node as the `index`-th child of `parent` (last, if not given)."""
        siblings = list(self.nodes[parent].children)
        siblings.insert(len(siblings) if index is None else index, node.id)
        return self.with_node(node).edited(parent, children=tuple(siblings))

    def removed(self, node_id: str) -> Tree:
        """Returns the tree without the node and its descendants."""
        gone = {node.id for node in self.walk(node_id)}
        nodes = {
            key: replace(node, children=tuple(child for child in node.children if child not in gone))
            if not gone.isdisjoint(node.children)
            else node
            for key, node in self.nodes.items()
            if key not in gone
        }
        return replace(
            self,
            nodes=nodes,
            root=None if self.root in gone else self.root,
            drafts=tuple(draft for draft in self.drafts if draft not in gone),
        )

    def moved(self, node_id: str, *, parent: str, index: int | None = None) -> Tree:
        """Returns the tree with a branch moved to another parent.

        Raises:
            ValueError: If the new parent is inside the branch.
        """
        if any(node.id == parent for node in self.walk(node_id)):
            raise ValueError(f"{node_id} cannot hang below itself")
        nodes = {
            key: replace(node, children=tuple(child for child in node.children if child != node_id))
            if node_id in node.children
            else node
            for key, node in self.nodes.items()
        }
        drafts = tuple(draft for draft in self.drafts if draft != node_id)
        tree = replace(self, nodes=nodes, drafts=drafts)
        return tree.inserted(tree.nodes[node_id], parent=parent, index=index)


def pointer(text: str, port: str = "") -> str | None:
    """Returns the blackboard key that a port's text names, or None for a literal.

    `{=}` means the entry with the name of the port. Outer blanks are permitted, as in BT.CPP.
    """
    key = bare_pointer(text)
    return port if key == "=" else key


def bare_pointer(text: str) -> str | None:
    """Returns what is within the braces of a key, or None for a literal; `{=}` has no meaning."""
    stripped = text.strip(BLANKS)
    if len(stripped) < 3 or stripped[0] != "{" or stripped[-1] != "}":
        return None
    return stripped[1:-1]


def reachable_trees(trees: Mapping[str, Tree], main: str) -> list[str]:
    """Returns the ids of the trees that `main` calls, in order of the first call; `main` is the first."""
    found: dict[str, None] = {}
    stack = [main]
    while stack:
        tree_id = stack.pop()
        if tree_id in found or tree_id not in trees:
            continue
        found[tree_id] = None
        stack.extend(reversed([node.tree for node in trees[tree_id].subtree_calls()]))
    return list(found)


def callees_first(trees: Mapping[str, Tree]) -> list[str]:
    """Returns the ids of trees so that each comes after those that it calls, unless they call it too."""
    order: dict[str, None] = {}
    seen: set[str] = set()
    stack = [(tree_id, False) for tree_id in reversed(list(trees))]
    while stack:
        tree_id, is_finished = stack.pop()
        if is_finished:
            order.setdefault(tree_id)
        elif tree_id not in seen:
            seen.add(tree_id)
            stack.append((tree_id, True))
            stack.extend((node.tree, False) for node in trees[tree_id].subtree_calls() if node.tree in trees)
    return list(order)


def used_types(trees: Iterable[Tree]) -> set[str]:
    """Returns the types of all nodes of the trees, without drafts."""
    return {node.type for tree in trees for node in tree.walk()}
