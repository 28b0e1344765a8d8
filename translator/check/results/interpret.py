"""Interprets a project's trees: which results each node can return, from the leaves to the root.

Called trees come first, and a SubTree node can return what the root of its tree can. A tree that calls itself
is an error; until that is repaired, the call that closes the ring can return anything.

Two sets are computed with the same rules. `may` holds every result that the node may return: other results
never happen. `named` starts from the results that actions state in their Python: the author intended these.
A finding that says *never* uses the first, one that says *can* uses the second.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from translator.check.results.controls import FALLBACKS, RESTING, SEQUENCES, of_control, rested
from translator.check.results.decorators import of_decorator
from translator.check.results.leaves import of_action, of_leaf
from translator.check.results.nav2 import is_of_library, of_nav2
from translator.check.results.sets import ALL, FALSE, TRUE, F, K, S

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from translator.project import Project
    from translator.tree import Node, Tree

_DECIDED: Final = (("_failureIf", F), ("_successIf", S), ("_skipIf", K))


@dataclass(slots=True)
class Results:
    """The sets of results of all nodes that run, by tree and node; bits as in `sets`."""

    may: dict[str, dict[str, int]] = field(default_factory=dict)
    named: dict[str, dict[str, int]] = field(default_factory=dict)
    library: dict[str, bool] = field(default_factory=dict)

    def is_library(self, type_: str) -> bool:
        """Returns whether a type that the trees use is a node of Nav2's library."""
        return self.library.get(type_, False)

    def of(self, tree: Tree, node_id: str) -> int:
        """Returns the results that a node may return; all of them if it is unknown."""
        return self.may.get(tree.id, {}).get(node_id, ALL)

    def named_of(self, tree: Tree, node_id: str) -> int:
        """Returns the results that a node can return for sure, if nothing stops it."""
        return self.named.get(tree.id, {}).get(node_id, 0)


def interpret(project: Project, order: Sequence[str]) -> Results:
    """Returns the results of all nodes of a project. `order`: its trees, called ones first."""
    results = Results()
    interpreter = _Interpreter(project, results)
    for tree_id in order:
        interpreter.read(project.trees[tree_id])
    return results


class _Interpreter:
    """Computes the sets of one project."""

    def __init__(self, project: Project, results: Results) -> None:
        self.project = project
        self.results = results
        self.roots: dict[str, tuple[int, int]] = {}
        self.leaves: dict[str, tuple[int, int]] = {}
        self.raised = F if project.settings.on_error == "failure" else 0  # an action that raises then fails

    def read(self, tree: Tree) -> None:
        nodes = list(tree.walk())
        resting = self.resting(nodes)
        may: dict[str, int] = {}
        named: dict[str, int] = {}
        for node in reversed(nodes):
            node_id = node.id
            if node.disabled:
                may[node_id] = named[node_id] = K
                continue
            known = [may.get(child, ALL) for child in node.children]
            stated = [named.get(child, 0) for child in node.children]
            own, shown = self.rule(node, known, stated)
            if node_id in resting:
                own |= _rested(node, known)
            if node.conditions:
                own, shown = _guarded(node.conditions, own), _guarded(node.conditions, shown)
            may[node_id], named[node_id] = own, shown
        self.results.may[tree.id], self.results.named[tree.id] = may, named
        root = tree.root or ""
        self.roots[tree.id] = may.get(root, ALL), named.get(root, 0)

    def rule(self, node: Node, known: list[int], stated: list[int]) -> tuple[int, int]:
        """Returns both sets of a node, without its conditions."""
        if node.is_subtree:
            return self.roots.get(node.tree, (ALL, 0))
        if not node.children:
            fixed = of_leaf(node)
            return (fixed, fixed) if fixed is not None else self.leaf(node.type)
        found = of_control(node, known)
        if found is not None:
            return found, of_control(node, stated) or 0
        if len(known) == 1 and (found := of_decorator(node, known[0])) is not None:
            return found, of_decorator(node, stated[0]) or 0
        if self.is_nav2(node.type) and (found := of_nav2(node.type, known)) is not None:
            return found | self.raised, of_nav2(node.type, stated) or 0
        return self.leaf(node.type)

    def leaf(self, type_: str) -> tuple[int, int]:
        found = self.leaves.get(type_)
        if found is None:
            found = self.leaves[type_] = self.own(type_)
        return found

    def own(self, type_: str) -> tuple[int, int]:
        action = self.project.actions.get(type_)
        if action is None:
            return ALL, 0
        if self.is_nav2(type_) and (fixed := of_nav2(type_, ())) is not None:
            return fixed | self.raised, fixed
        may, named = of_action(action)
        return may | self.raised, named

    def is_nav2(self, type_: str) -> bool:
        found = self.results.library.get(type_)
        if found is None:
            action = self.project.actions.get(type_)
            found = self.results.library[type_] = action is not None and is_of_library(action)
        return found

    def resting(self, nodes: Sequence[Node]) -> set[str]:
        """Returns the nodes that keep a result, since their parent does not reset them."""
        found: set[str] = set()
        for node in nodes:
            if node.type in RESTING:
                found.update(node.children[:1])
            elif node.children and node.type in self.project.actions:
                found.update(node.children)
        return found


def _rested(node: Node, children: Sequence[int]) -> int:
    if node.type in SEQUENCES:
        return rested(children, S, F)
    return rested(children, F, S) if node.type in FALLBACKS else 0


def _guarded(conditions: Mapping[str, str], results: int) -> int:
    """Returns the set of a node with pre-conditions; a constant one decides without a tick, or never."""
    found = 0
    for name, result in _DECIDED:
        code = conditions.get(name)
        if code is None or (text := code.strip()) in FALSE:
            continue
        found |= result
        if text in TRUE:
            return found
    code = conditions.get("_while")
    if code is not None and (text := code.strip()) not in TRUE:
        found |= K
        if text in FALSE:
            return found
    return found | results
