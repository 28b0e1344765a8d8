"""Reads a launch file in YAML or XML as the same tree of actions, with the place of each.

`<node pkg="a"><param name="b"/></node>` becomes `{"node": {"pkg": "a", "param": [{"name": "b"}]}}`; ROS 2's
two formats mean the same. `<launch>` and `<group>` hold actions. In YAML a group is their list, or
`children:` beside its own values.
"""

from __future__ import annotations

from typing import Any, Final

from lxml import etree

from executor.universes.document import (
    MAX_BYTES,
    MAX_DEPTH,
    DocumentError,
    Located,
    Path,
    Problem,
    read_yaml,
    text_of,
)

__all__ = ["CODE", "read_document"]

CODE: Final = "BTL001"
_HOLD_ACTIONS: Final = frozenset({"launch", "group"})


def read_document(raw: bytes, file: str) -> Located:
    """Returns the document of a launch file; its value is `{"launch": [actions]}`.

    Raises:
        DocumentError: it cannot be read, or is no launch file.
    """
    if file.endswith(".xml"):
        return _read_xml(raw, file)
    document = read_yaml(text_of(raw, file), file, as_ros=True)
    top = document.value
    if not isinstance(top, dict) or not isinstance(top.get("launch"), list):
        line, column = document.place(())
        text = "a launch file is `launch:` with a list of actions"
        raise DocumentError([Problem(text, line, column, CODE)], file)
    return document


def _read_xml(raw: bytes, file: str) -> Located:
    if len(raw) > MAX_BYTES:
        raise DocumentError([Problem(f"the document is larger than {MAX_BYTES} bytes", code="BTU002")], file)
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False)
    try:
        root = etree.fromstring(raw, parser)
    except etree.XMLSyntaxError as error:
        line, column = error.position
        raise DocumentError([Problem(str(error.msg), line or 1, column or 1, CODE)], file) from error
    if root.getroottree().docinfo.internalDTD is not None:
        raise DocumentError([Problem("a launch file has no document type", code=CODE)], file)
    if root.tag != "launch":
        problem = Problem(f"a launch file begins with <launch>, not <{root.tag}>", *_place(root), CODE)
        raise DocumentError([problem], file)
    places: dict[Path, tuple[int, int]] = {}
    return Located({"launch": _actions(root, ("launch",), places, file)}, places)


def _actions(
    element: etree._Element, here: Path, places: dict[Path, tuple[int, int]], file: str
) -> list[dict[str, Any]]:
    if len(here) > 2 * MAX_DEPTH:
        raise DocumentError(
            [Problem(f"the document is nested deeper than {MAX_DEPTH}", *_place(element), CODE)], file
        )
    places[here] = _place(element)
    found: list[dict[str, Any]] = []
    for child in element.iterchildren(tag=etree.Element):
        kind, place = str(child.tag), (*here, len(found), str(child.tag))
        places[place[:-1]] = places[place] = _place(child)
        if kind in _HOLD_ACTIONS:
            children = _actions(child, (*place, "children"), places, file)
            found.append({kind: {**_attributes(child), "children": children}})
        else:
            found.append({kind: _values(child, place, places)})
    return found


def _values(element: etree._Element, here: Path, places: dict[Path, tuple[int, int]]) -> dict[str, Any]:
    places[here] = _place(element)
    values = _attributes(element)
    for child in element.iterchildren(tag=etree.Element):
        entries = values.setdefault(str(child.tag), [])
        if isinstance(entries, list) and len(here) < 2 * MAX_DEPTH:
            entries.append(_values(child, (*here, str(child.tag), len(entries)), places))
    return values


def _attributes(element: etree._Element) -> dict[str, Any]:
    return {str(name): str(value) for name, value in element.attrib.items()}


def _place(element: etree._Element) -> tuple[int, int]:
    """Returns the line of an element; XML's reader gives no column."""
    return int(str(element.sourceline)), 1  # the type in lxml's stub includes an ellipsis
