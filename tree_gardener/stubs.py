"""Stubs: actions and control nodes of an import that have no code yet; a stub always fails."""

import linecache
import sys
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tree_gardener.tree import Tree

STUB_MARK: Final = "bt-studio: to be written"
STUB_UPDATE: Final = "    def update(self):\n        return py_trees.common.Status.FAILURE\n"
STUB_CONTROL_UPDATE: Final = "    def update(self):\n        return Status.FAILURE\n"


def is_stub(source: str) -> bool:
    """Returns whether the source of an action is an unchanged stub of the importer."""
    text = source.replace("\r\n", "\n")
    return STUB_MARK in text and (STUB_UPDATE in text or STUB_CONTROL_UPDATE in text)


def unwritten(tree: "Tree") -> list[str]:
    """Returns the names of a tree's actions that are stubs."""
    found = set()
    for node in tree.nodes:
        own = getattr(node, "instance_behaviour", None)
        if own is not None and node.type not in found and is_stub(_source_of(own)):
            found.add(node.type)
    return sorted(found)


def stubs_sentence(names: "Sequence[str]") -> str:
    """Returns a sentence that names the stubs and the next step."""
    one = len(names) == 1
    listed = names[0] if one else f"{', '.join(names[:-1])} and {names[-1]}"
    is_are = "is an unwritten stub, which always fails" if one else "are unwritten stubs, which always fail"
    files = ", ".join(f"actions/{name}.py" for name in names)
    return f"{listed} {is_are}: write update() in {files}."


def _source_of(behaviour: object) -> str:
    module = sys.modules.get(type(behaviour).__module__)
    file = getattr(module, "__file__", None)
    return "".join(linecache.getlines(file)) if file and file.startswith("actions/") else ""
