"""The context of all checks: the project, the list of findings, and the kinds of nodes."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

from translator.check.results import Results, interpret
from translator.check.uses import Keys, uses_of
from translator.diagnostic import Diagnostic, Place, Severity, Step, diagnostic
from translator.diagram import diagram_path
from translator.enums import constants
from translator.tree import Node, Tree, callees_first, reachable_trees

if TYPE_CHECKING:
    from translator.catalog import NodeModel
    from translator.project import Project

_INSTANTIATED = ("BT02", "BT03")  # ports and scripts, which are checked when a tree is built


@dataclass
class Context:
    """One run of the checks over a project."""

    project: Project
    found: list[Diagnostic] = field(default_factory=list)
    _models: dict[str, NodeModel | None] = field(default_factory=dict)

    def model(self, type_: str) -> NodeModel | None:
        """Returns the model of a type of node, or None for an unknown one."""
        if type_ not in self._models:
            self._models[type_] = self.project.model(type_)
        return self._models[type_]

    @cached_property
    def constants(self) -> dict[str, int]:
        """Returns the numbers that scripts know by name."""
        return constants(self.project.enums)

    @cached_property
    def reachable(self) -> set[str]:
        """Returns the trees that can be reached from the main tree."""
        return set(reachable_trees(self.project.trees, self.project.settings.main_tree))

    @cached_property
    def order(self) -> list[str]:
        """Returns the trees so that each comes after those that it calls."""
        return callees_first(self.project.trees)

    @cached_property
    def results(self) -> Results:
        """Returns the results that each node can return."""
        return interpret(self.project, self.order)

    @cached_property
    def keys(self) -> dict[str, Keys]:
        """Returns the keys of the blackboard that each tree uses."""
        return uses_of(self)

    @cached_property
    def calls(self) -> dict[str, list[tuple[Tree, Node]]]:
        """Returns for each tree its calls from reachable trees; each call has the calling tree."""
        found: dict[str, list[tuple[Tree, Node]]] = {}
        for tree_id in sorted(self.reachable):
            tree = self.project.trees[tree_id]
            for node in tree.subtree_calls():
                found.setdefault(node.tree, []).append((tree, node))
        return found

    def report(
        self,
        code: str,
        tree: Tree,
        node: Node | None = None,
        port: str = "",
        steps: tuple[Step, ...] = (),
        /,
        **values: object,
    ) -> None:
        """Adds a finding at a node of a tree. `steps` lead over the nodes from which it follows."""
        self._add(code, (tree, node, port), steps, None, values)

    def report_as(
        self,
        severity: Severity | None,
        code: str,
        tree: Tree,
        node: Node | None = None,
        port: str = "",
        /,
        **values: object,
    ) -> None:
        """Adds a finding whose severity is another one than that of its code, unless it is None."""
        self._add(code, (tree, node, port), (), severity, values)

    def _add(
        self,
        code: str,
        where: tuple[Tree, Node | None, str],
        steps: tuple[Step, ...],
        severity: Severity | None,
        values: dict[str, object],
    ) -> None:
        tree, node, port = where
        place = Place(
            file=tree.file or diagram_path(tree.id),
            tree=tree.id,
            node=node.id if node else "",
            port=port,
            line=node.span.line if node and node.span else None,
            column=node.span.column if node and node.span else None,
        )
        found = diagnostic(code, place, **values)
        if steps:
            found = replace(found, path=steps)
        if severity is not None:
            found = replace(found, severity=severity)
        if found.is_error and code.startswith(_INSTANTIATED) and tree.id not in self.reachable:
            # The engine never builds a tree that nothing calls, so the rest can run.
            found = replace(found, severity=Severity.WARNING)
        self.found.append(found)


def located(found: list[Diagnostic], project: Project) -> list[Diagnostic]:
    """Adds line and column to findings that name a node of a diagram."""
    indexes: dict[str, dict[str, tuple[int, int]]] = {}
    result = []
    for item in found:
        place = item.place
        if place.line is None and place.node and place.file.endswith(".json") and place.file in project.files:
            index = indexes.get(place.file)
            if index is None:
                index = indexes[place.file] = _key_positions(project.files[place.file])
            line, column = index.get(place.node, (1, 1))
            result.append(item.moved(line=line, column=column))
        else:
            result.append(item)
    return result


_NODE_KEY = re.compile(r'"((?:[^"\\]|\\.)*)"\s*:\s*\{')


def _key_positions(raw: bytes) -> dict[str, tuple[int, int]]:
    """Returns the position of each key of a JSON text whose value is an object, to locate nodes."""
    positions: dict[str, tuple[int, int]] = {}
    for number, line in enumerate(raw.decode("utf-8", "replace").splitlines(), start=1):
        for match in _NODE_KEY.finditer(line):
            positions.setdefault(match.group(1), (number, match.start() + 1))
    return positions
