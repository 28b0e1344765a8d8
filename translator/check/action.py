"""Checks of the actions that the trees use; findings in their sources are reported when they are loaded."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING

from translator.action import source_text
from translator.action_returns import returns_of
from translator.action_waits import waiting_calls
from translator.diagnostic import Place, diagnostic
from translator.message_fields import wrong_fields
from translator.python_source import parse
from translator.settings import NO_UNIVERSE
from translator.shared_modules import shared_modules
from translator.text import is_clean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.action import ActionModel
    from translator.check.context import Context
    from translator.diagnostic import Diagnostic


def check_actions(context: Context) -> None:
    """Reports actions that are used but have no code yet."""
    from tree_gardener.stubs import is_stub  # noqa: PLC0415 - the engine loads py_trees

    used = {node.type: (tree, node) for tree in context.project.trees.values() for node in tree.walk()}
    for name, action in context.project.actions.items():
        if name in used and is_stub(action.source):
            tree, node = used[name]
            context.report("BT0613", tree, node, name=name, path=action.path)
        if not is_clean(source_text(action.source)):
            place = Place(action.path, line=1)
            context.found.append(diagnostic("BT0614", place))
        context.found.extend(_unknown_types(action))
        if name in used and (returns := returns_of(action.source, name)).problem:
            place = Place(action.path, line=returns.line)
            context.found.append(diagnostic("BT0617", place, name=name, problem=returns.problem))
    own = [name for name in context.project.actions if name in used]
    _check_modules(context, own)
    _check_waits(context, own)
    _check_messages(context, own)


def _check_messages(context: Context, used: list[str]) -> None:
    """Reports values that a field of a ROS message surely refuses."""
    actions = [context.project.actions[name] for name in used]
    sources = {
        action.path: (action.source, {port.name: port.type for port in action.ports}) for action in actions
    }
    for module in shared_modules(context.project, used):
        sources.setdefault(module.path, (module.source, {}))
    for path, (source, ports) in sources.items():
        for wrong in wrong_fields(source, path, ports):
            place = Place(path, line=wrong.line)
            context.found.append(
                diagnostic(
                    "BT0631",
                    place,
                    field=wrong.field,
                    wanted=wrong.wanted,
                    given=wrong.given,
                    remedy=wrong.remedy,
                )
                if wrong.wanted
                else diagnostic("BT0632", place, field=wrong.field, fields=wrong.given)
            )


def _check_waits(context: Context, used: list[str]) -> None:
    """Reports calls that stop the world of an exact run."""
    settings = context.project.settings
    if settings.time != "exact" or settings.universe == NO_UNIVERSE:
        return
    for name in used:
        action = context.project.actions[name]
        for call in waiting_calls(action.source, name):
            place = Place(action.path, line=call.line)
            context.found.append(diagnostic("BT0622", place, call=call.name, method=call.method, name=name))


def _check_modules(context: Context, used: list[str]) -> None:
    """Reports modules that cannot be stored in XML."""
    for module in shared_modules(context.project, used):
        if not is_clean(source_text(module.source)) and module.name not in context.project.actions:
            context.found.append(diagnostic("BT0614", Place(module.path, line=1)))


def _unknown_types(action: ActionModel) -> Iterator[Diagnostic]:
    """Yields a finding for each port whose type is a text that names no enumeration."""
    ports = [port for port in action.ports if port.type == "any" and port.named.isidentifier()]
    known = _names_in(action) if ports else set()
    for port in ports:
        if port.named not in known:
            at = re.search(rf"""["']{port.named}["']""", action.source)
            line = action.source.count("\n", 0, at.start()) + 1 if at else action.line
            yield diagnostic(
                "BT0616", Place(action.path, port=port.name, line=line), port=port.name, type=port.named
            )


def _names_in(action: ActionModel) -> set[str]:
    """Returns the classes and modules that a source knows by name, such as those that it registers."""
    try:
        module = parse(action.source, action.path)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set()
    return {
        name
        for node in ast.walk(module)
        for name in (getattr(node, "id", ""), getattr(node, "name", ""), getattr(node, "asname", ""))
        if isinstance(name, str)
    }
