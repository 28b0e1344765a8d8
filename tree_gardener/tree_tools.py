"""The port functions of JdeRobot BT Studio's actions; importable as top-level ``tree_tools`` too.

New actions use `tree_gardener.ports` instead.
"""

import re
import sys
from typing import Any

from tree_gardener.blackboard import EMPTY, Blackboard

_KEY = re.compile(r"\s*\{(.+)\}\s*\Z", re.DOTALL)
_state: dict[str, Blackboard] = {}


def use_blackboard(board: Blackboard) -> None:
    """Sets the blackboard for plain texts: that of the tree that was made last."""
    _state["board"] = board


def _entry_of(text: str) -> tuple[Blackboard, str] | None:
    match = _KEY.match(text)
    if match is None:
        return None
    board = getattr(text, "board", None)  # not tested by truth: an empty blackboard is false
    if board is None:
        board = _state.get("board")
    if board is None:
        board = _state["board"] = Blackboard()
    key = match.group(1)
    return board, getattr(text, "port", key) if key == "=" else key


def get_port_content(port_value: str) -> Any:
    """Returns the text itself, or for ``{key}`` the value of the entry; ``""`` if it was never written."""
    place = _entry_of(port_value)
    if place is None:
        return str(port_value)
    entry = place[0].find(place[1])
    return "" if entry is None or entry.value is EMPTY else entry.value


def set_port_content(port_value: str, value: Any) -> None:
    """Writes the entry that ``{key}`` names.

    Raises:
        ValueError: the text is a literal.
    """
    place = _entry_of(port_value)
    if place is None:
        raise ValueError(f"'{port_value}' is a value, not a port that can be written; use {{key}}")
    board, key = place
    entry = board.find(key) or board.create(key, None)
    entry.write(value, getattr(port_value, "writer", 0))


def install() -> None:
    """Makes ``import tree_tools`` find this module."""
    sys.modules.setdefault("tree_tools", sys.modules[__name__])
