"""Runs the checks of users' Python; the same list for the page, a project and a single file."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from translator.action import KEPT_BYTES
from translator.check.sources.found import Found, Moment
from translator.check.sources.imports import Imports
from translator.check.sources.methods import Methods
from translator.check.sources.modules import Modules
from translator.check.sources.names import unknown_names
from translator.check.sources.scopes import Scopes
from translator.diagnostic import Diagnostic, Place, Severity, diagnostic
from translator.limits import ACTION_BYTES
from translator.python_source import parse
from translator.shared_modules import shared_modules

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator.action import ActionModel
    from translator.check.context import Context


def check_sources(context: Context) -> None:
    """Reports what is wrong in the Python of actions, and of the modules that they import.

    Only what surely stops the run is an error: what is wrong where an action is loaded, or made in a tree
    that runs.
    """
    project = context.project
    loaded = {node.type for tree in project.trees.values() for node in tree.walk()}
    made = {node.type for tree_id in context.reachable for node in project.trees[tree_id].walk()}
    modules = Modules(project.files)
    used = [name for name in project.actions if name in loaded]
    for name, action in project.actions.items():
        moments = {Moment.LOAD} if name in loaded else set()
        if name in made:
            moments.add(Moment.MAKE)
        context.found.extend(_reported(_findings(action.source, name, modules), action.path, moments))
    for module in shared_modules(project, used):
        if module.name not in project.actions:
            found = _findings(module.source, module.name, modules)
            context.found.extend(_reported(found, module.path, {Moment.LOAD}))


def source_findings(action: ActionModel, files: Mapping[str, bytes] | None = None) -> tuple[Diagnostic, ...]:
    """Returns all findings about a single source; without `files`, any module may be its neighbour."""
    found = _findings(action.source, action.name, None if files is None else Modules(files))
    return (*action.diagnostics, *_reported(found, action.path, {Moment.LOAD, Moment.MAKE}))


def _reported(found: tuple[Found, ...], path: str, errors: set[Moment]) -> list[Diagnostic]:
    result = []
    for each in found:
        item = diagnostic(each.code, Place(path, line=each.line, column=each.column), **each.values)
        if item.is_error and each.moment not in errors:
            item = replace(item, severity=Severity.WARNING)
        result.append(item)
    return result


def _findings(source: str, name: str, modules: Modules | None) -> tuple[Found, ...]:
    read = (_kept if len(source) <= KEPT_BYTES else _read)(source, name)
    if read is None:
        return ()
    scopes, own = read
    imports = Imports(scopes, modules or Modules({}), has_project=modules is not None)
    return (*own, *imports.findings())


def _read(source: str, name: str) -> tuple[Scopes, tuple[Found, ...]] | None:
    """Returns the scopes of a source, and what is wrong with it whatever the project has."""
    if len(source) > ACTION_BYTES:
        return None
    try:
        module = parse(source, f"actions/{name}.py")
        methods = Methods(module, name)
        scopes = Scopes(module, methods.made())
        return scopes, (*unknown_names(scopes), *methods.findings())
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None  # `inspect_action` reports it


_kept = lru_cache(maxsize=1024)(_read)
