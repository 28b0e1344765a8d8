"""Converts a node's properties to XML attributes and back.

BehaviorTree.CPP ignores attributes that begin with `_`, except conditions and `_autoremap`. So ids,
positions, colours and comments are stored in such attributes.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from translator.text import is_xml_name
from translator.tree import CONDITIONS, SUBTREE, Node

if TYPE_CHECKING:
    from collections.abc import Mapping

ID = "_bts_id"
POSITION = "_bts_pos"
COLOR = "_bts_color"
COLLAPSED = "_bts_collapsed"
DISABLED = "_bts_disabled"
COMMENT = "_description"
SILENCED = "_bts_silenced"
UNREADABLE = "?"
"""Stands for the code of a silence that is not JSON, so that its text is kept and reported."""
METADATA = (COMMENT, ID, POSITION, COLOR, COLLAPSED, DISABLED, SILENCED)
# A disabled node must be skipped in any case; its own conditions are kept under other names.
HIDDEN = {name: f"_bts_{name[1:]}" for name in ("_failureIf", "_successIf", "_skipIf")}
_SHOWN = {hidden: name for name, hidden in HIDDEN.items()}
_RESERVED = {"name", "ID", *METADATA, *CONDITIONS, *_SHOWN}


def is_free(name: str) -> bool:
    """Returns whether an attribute may be kept for another program: BT Studio and BT.CPP do not read it."""
    return name.startswith("_") and name not in _RESERVED and is_xml_name(name)


def to_attributes(node: Node) -> dict[str, str]:
    """Returns the attributes of a node in their canonical order."""
    result: dict[str, str] = {}
    if node.type == SUBTREE:
        result["ID"] = node.tree
    if node.name or node.has_empty_name:
        result["name"] = node.name
    for name, text in node.ports.items():
        result.setdefault(name, text)
    result.update((name, text) for name, text in node.attributes.items() if is_free(name))
    for name, text in node.conditions.items():
        result[HIDDEN.get(name, name) if node.disabled else name] = text
    if node.disabled:
        result["_skipIf"] = "true"
        result[DISABLED] = "1"
    if node.comment:
        result[COMMENT] = node.comment
    result[ID] = node.id
    if node.position is not None:
        result[POSITION] = ";".join(_number(value) for value in node.position)
    if node.color:
        result[COLOR] = node.color
    if node.collapsed:
        result[COLLAPSED] = "1"
    if node.silenced:
        result[SILENCED] = json.dumps(dict(node.silenced), ensure_ascii=False)
    return result


def from_attributes(attributes: Mapping[str, str], *, is_subtree: bool) -> dict[str, Any]:
    """Returns the fields of a node from its attributes; `id` is missing if they do not contain it."""
    fields: dict[str, Any] = {"ports": {}, "conditions": {}, "attributes": {}}
    disabled = attributes.get(DISABLED) == "1" and attributes.get("_skipIf") == "true"
    for name, text in attributes.items():
        if name == "name":
            fields["name"], fields["has_empty_name"] = text, not text
        elif name == "ID":
            if is_subtree:
                fields["tree"] = text
        elif name in METADATA:
            _set_metadata(fields, name, text)
        elif disabled and name in _SHOWN:
            fields["conditions"][_SHOWN[name]] = text
        elif name in CONDITIONS:
            if not (disabled and name == "_skipIf"):
                fields["conditions"][name] = text
        else:
            fields["attributes" if name.startswith("_") else "ports"][name] = text
    fields["disabled"] = disabled
    return fields


def _set_metadata(fields: dict[str, Any], name: str, text: str) -> None:
    if name == ID:
        fields["id"] = text
    elif name == COMMENT:
        fields["comment"] = text
    elif name == COLOR:
        fields["color"] = text
    elif name == COLLAPSED:
        fields["collapsed"] = text == "1"
    elif name == SILENCED:
        fields["silenced"] = _silenced(text)
    elif name == POSITION:
        fields["position"] = _position(text)


def _silenced(text: str) -> dict[str, str]:
    try:
        rows = json.loads(text)
    except (ValueError, RecursionError):
        rows = None
    if not isinstance(rows, dict) or not all(isinstance(reason, str) for reason in rows.values()):
        return {UNREADABLE: text}
    return rows


def _position(text: str) -> tuple[float, float] | None:
    try:
        x, y = (float(part) for part in text.split(";"))
    except ValueError:
        return None
    return (x, y) if abs(x) < 1e9 and abs(y) < 1e9 else None


def _number(value: float) -> str:
    return str(int(value)) if value == int(value) else repr(float(value))
