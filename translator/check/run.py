"""Runs all checks over a project; causes are checked before their effects."""

from __future__ import annotations

from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

from translator.check.action import check_actions
from translator.check.conflict import check_conflicts
from translator.check.context import Context, located
from translator.check.dataflow import check_dataflow
from translator.check.effect import check_effects
from translator.check.endless import check_endless_loops
from translator.check.entry_types import check_entry_types
from translator.check.late_script import check_late_scripts
from translator.check.nav2 import check_nav2
from translator.check.nobody import check_nobody
from translator.check.order import check_order
from translator.check.port import check_ports
from translator.check.reach import check_reachability
from translator.check.script import check_scripts
from translator.check.silence import without_silenced
from translator.check.sources import check_sources
from translator.check.structure import check_structure
from translator.check.subtree import check_subtrees
from translator.check.together import check_together
from translator.limits import OVERSIZE

if TYPE_CHECKING:
    from translator.diagnostic import Diagnostic
    from translator.project import Project


def check(project: Project) -> tuple[Diagnostic, ...]:
    """Returns all findings about a project, including those from reading it.

    Each finding has a place: a file, and a node or a line in the file. Only findings of severity *error*
    prevent a translation of the project.
    """
    # Exporting runs the checks again; a project is immutable, so the first result is kept.
    found = _found.get(project)
    if found is None:
        found = _found[project] = _check(project)
    return found


_found: WeakKeyDictionary[Project, tuple[Diagnostic, ...]] = WeakKeyDictionary()


def _check(project: Project) -> tuple[Diagnostic, ...]:
    if any(item.code in OVERSIZE for item in project.diagnostics):
        return tuple(
            located(list(project.diagnostics), project)
        )  # the project is not translated, so no further check is needed
    context = Context(project, list(project.diagnostics))
    check_structure(context)
    check_conflicts(context)
    check_actions(context)
    check_sources(context)
    check_nav2(context)
    check_nobody(context)
    check_ports(context)
    check_entry_types(context)
    check_scripts(context)
    check_late_scripts(context)
    check_subtrees(context)
    check_dataflow(context)
    check_order(context)
    check_reachability(context)
    check_effects(context)
    check_endless_loops(context)
    check_together(context)
    return tuple(located(without_silenced(context), project))
