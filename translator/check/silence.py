"""Leaves out the findings that a node silences, each with a reason.

Only warnings and notes can be silenced; a tree with an error does not run, whatever is written on its nodes.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from translator.diagnostic import rules

if TYPE_CHECKING:
    from translator.check.context import Context
    from translator.diagnostic import Diagnostic

_CODE: Final = re.compile(r"BT[0-9]{4}")


def without_silenced(context: Context) -> list[Diagnostic]:
    """Returns the findings that are not silenced, and one for each silence that does not count."""
    counting = _counting(context)
    return [
        found
        for found in context.found
        if found.is_error or (found.place.tree, found.place.node, found.code) not in counting
    ]


def _counting(context: Context) -> set[tuple[str, str, str]]:
    """Returns tree, node and code of each silence that counts; reports the others."""
    errors = {(item.place.tree, item.place.node, item.code) for item in context.found if item.is_error}
    counting: set[tuple[str, str, str]] = set()
    for tree in context.project.trees.values():
        for node in tree.nodes.values():
            for code, reason in node.silenced.items():
                place = tree.id, node.id, code
                if not _CODE.fullmatch(code) or code not in rules():
                    context.report("BT0128", tree, node, silenced=code[:40])
                elif not reason.strip():
                    context.report("BT0127", tree, node, silenced=code)
                elif place in errors:
                    context.report("BT0126", tree, node, silenced=code)
                else:
                    counting.add(place)
    return counting
