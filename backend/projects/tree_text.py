"""The text of one tree, for the editor that shows XML beside the canvas; nothing is stored."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from backend.projects.checking import refuse

if TYPE_CHECKING:
    from collections.abc import Sequence

    from translator import Tree
    from translator.tree_text import TreeText


def write(diagram: str, *, base: str, ids: Sequence[str]) -> dict[str, Any]:
    """A diagram as XML, patched into an earlier text of it where there is one.

    Raises:
        CheckFailedError: the diagram or the earlier text cannot be read.
    """
    from translator import TranslatorError  # noqa: PLC0415 - keeps the start of the server short
    from translator.tree_text import write_tree_text  # noqa: PLC0415

    try:
        return _text(write_tree_text(_tree(diagram), base=base, ids=ids))
    except TranslatorError as error:
        refuse(error)


def read(xml: str, diagram: str) -> dict[str, Any]:
    """The diagram that an edited text stands for; `diagram` is what it was before.

    A text that is half typed is nothing out of the ordinary: it has no diagram, and findings that say why.

    Raises:
        CheckFailedError: the diagram before cannot be read.
    """
    from translator import TranslatorError  # noqa: PLC0415
    from translator.diagram import diagram_text  # noqa: PLC0415
    from translator.tree_text import read_tree_text  # noqa: PLC0415

    try:
        now = _tree(diagram)
    except TranslatorError as error:
        refuse(error)
    try:
        found = read_tree_text(xml, now)
    except TranslatorError as error:
        told = [item.to_json() for item in error.diagnostics]
        return {"xml": xml, "ranges": [], "diagram": None, "diagnostics": told}
    told = [item.to_json() for item in found.diagnostics]
    return _text(found.text) | {"diagram": diagram_text(found.tree), "diagnostics": told}


def _tree(diagram: str) -> Tree:
    from translator import TranslatorError  # noqa: PLC0415
    from translator.diagram import restore  # noqa: PLC0415

    tree, found = restore(diagram, file="diagram.json")
    if tree is None:
        raise TranslatorError(found)
    return tree


def _text(text: TreeText) -> dict[str, Any]:
    ranges = [{"node": r.node, "start": r.start, "open_end": r.open_end, "end": r.end} for r in text.ranges]
    return {"xml": text.xml, "ranges": ranges}
