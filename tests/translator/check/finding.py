"""Shared by the tests of single checks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from translator.check.context import Context, located
from translator.diagnostic import rules

if TYPE_CHECKING:
    from collections.abc import Callable

    from translator import Diagnostic, Project

LEAF = {"type": "AlwaysSuccess"}
Case = tuple[str, Any, str]


def findings(one: Callable[[Context], None], project: Project) -> list[Diagnostic]:
    """The findings of one check alone."""
    context = Context(project)
    one(context)
    return located(context.found, project)


def find(one: Callable[[Context], None], project: Project, code: str) -> Diagnostic:
    """The finding with a code."""
    found = [item for item in findings(one, project) if item.code == code]
    assert found, f"{code} is not among {[str(item) for item in findings(one, project)]}"
    return found[0]


def is_found_at_its_place(
    one: Callable[[Context], None], make_project: Callable[..., Project], case: Case
) -> None:
    """Checks that a case's finding names the node, its line, and what to do."""
    code, nodes, node = case
    found = find(one, make_project(nodes, trees={"Other": {"n1": LEAF}}), code)
    assert (found.place.tree, found.place.node) == ("MainTree", node)
    assert (found.place.file, found.place.line) == ("trees/MainTree.json", 1)
    assert found.place.column is not None
    assert found.place.column > 1
    assert found.message
    assert found.hint
    assert found.severity is rules()[code].severity
