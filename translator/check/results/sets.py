"""Sets of results as bits of a number, and the literals of ports from which they follow.

`YIELDS` is a RUNNING that wakes the tree up at once: `tick_once` ticks again without a pause. It counts as
RUNNING wherever only results matter; the check of loops needs the difference.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from translator.tree import pointer

if TYPE_CHECKING:
    from collections.abc import Iterable

    from translator.tree import Node

S: Final = 1
F: Final = 2
R: Final = 4
K: Final = 8
YIELDS: Final = 16
RUNS: Final = R | YIELDS
DONE: Final = S | F
ALL: Final = S | F | R | K
NAMES: Final = {"SUCCESS": S, "FAILURE": F, "RUNNING": R, "SKIPPED": K}
TRUE: Final = frozenset({"true", "1"})
FALSE: Final = frozenset({"false", "0"})
_WORDS: Final = ((S, "succeeds"), (F, "fails"), (R, "runs"), (K, "is skipped"))
_WHOLE: Final = re.compile(r"-?[0-9]+")


def names_of(results: int) -> list[str]:
    """Returns the names of the results in a set, such as SUCCESS, in a fixed order."""
    merged = results | (R if results & YIELDS else 0)
    return [name for name, bit in NAMES.items() if merged & bit]


def set_of(names: Iterable[str]) -> int:
    """Returns the set of some results by name; unknown names are passed over."""
    found = 0
    for name in names:
        found |= NAMES.get(name, 0)
    return found


def words(results: int) -> str:
    """Returns what a node with these results does, for a message: “succeeds or runs”."""
    merged = results | (R if results & YIELDS else 0)
    return " or ".join(word for bit, word in _WORDS if merged & bit) or "never ends"


def literal(node: Node, port: str, default: str | None = None) -> str | None:
    """Returns the literal in a port, or its default; None if it names an entry or is not given."""
    text = node.ports.get(port, default)
    return None if text is None or pointer(text, port) is not None else text


def whole(node: Node, port: str, default: int | None = None) -> int | None:
    """Returns the integer in a port as the engine reads it: only its beginning counts; None if unknown."""
    text = literal(node, port, None if default is None else str(default))
    match = _WHOLE.match(text) if text is not None else None
    return int(match.group()) if match else None
