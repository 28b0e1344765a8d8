"""Reads `<Root>`: as the document's element, and as the first node of a tree, as early Groot wrote it.

BehaviorTree.CPP refuses both. The bytes are changed in place, so that all other places stay.
"""

from __future__ import annotations

import codecs
import re
from dataclasses import replace
from typing import TYPE_CHECKING

from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.xml.source import parse_source

if TYPE_CHECKING:
    from translator.xml.source import Element, Source

ROOT = "Root"
_BEFORE = r"(?:\s|<\?.*?\?>|<!--.*?-->)*"
_CAPITAL = re.compile(rf"\ufeff?{_BEFORE}<{ROOT}(?P<attributes>(?:[\s/][^>]*)?)>", re.DOTALL)
_CODECS = {codecs.BOM_UTF16_LE: "utf-16-le", codecs.BOM_UTF16_BE: "utf-16-be"}


def capital_root(raw: bytes | str) -> str | None:
    """Returns the attributes of a document's `<Root>`, as a text; None if its element has another name."""
    if isinstance(raw, bytes):
        raw = raw.decode(_CODECS.get(raw[:2], "utf-8"), "replace")
    match = _CAPITAL.match(raw)
    return match["attributes"] if match is not None else None


def with_small_root(source: Source) -> tuple[Source, list[Diagnostic]]:
    """Returns a document with `<root>`, and without nodes `<Root>`; each change is noted."""
    data = bytearray(source.data)
    notes = []
    if source.root.tag == ROOT:
        _rename(data, source.root)
        notes.append(_note("BT0709", source, source.root))
    for tree in source.root.children:
        for node in tree.children if tree.tag == "BehaviorTree" else ():
            if node.tag == ROOT and "ID" not in node.attributes:
                _blank(data, node)
                notes.append(_note("BT0721", source, node, id=tree.attributes.get("ID", "")))
    if not notes:
        return source, []
    changed = parse_source(codecs.BOM_UTF8 + bytes(data), file=source.file)
    return replace(changed, encoding=source.encoding, bom=source.bom), notes


def _note(code: str, source: Source, element: Element, **values: object) -> Diagnostic:
    return diagnostic(code, Place(source.file, line=element.line, column=element.column), **values)


def _rename(data: bytearray, element: Element) -> None:
    data[element.start + 1 : element.start + 2] = b"r"
    closing = data.rfind(b"</", element.open_end, element.end)
    if closing >= 0:
        data[closing + 2 : closing + 3] = b"r"


def _blank(data: bytearray, element: Element) -> None:
    data[element.start : element.open_end] = b" " * (element.open_end - element.start)
    closing = data.rfind(b"</", element.open_end, element.end)
    if closing >= element.open_end:
        data[closing : element.end] = b" " * (element.end - closing)
