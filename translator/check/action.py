"""Checks of the actions that the trees use; findings in their sources are reported when they are loaded."""

from __future__ import annotations

from typing import TYPE_CHECKING

from translator.action import source_text
from translator.diagnostic import Place, diagnostic
from translator.text import is_clean

if TYPE_CHECKING:
    from translator.check.context import Context


def check_actions(context: Context) -> None:
    """Reports actions that are used but have no code yet."""
    from tree_gardener.stubs import is_stub  # noqa: PLC0415 - the engine loads py_trees

    used = {node.type: (tree, node) for tree in context.project.trees.values() for node in tree.walk()}
    for name, action in context.project.actions.items():
        if name in used and is_stub(action.source):
            tree, node = used[name]
            context.report("BT0613", tree, node, name=name, path=action.path)
        if not is_clean(source_text(action)):
            place = Place(action.path, line=1)
            context.found.append(diagnostic("BT0614", place))
