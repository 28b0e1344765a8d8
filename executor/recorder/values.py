"""Values of the blackboard in recordings: canonical JSON, or a preview. Pure."""

from __future__ import annotations

import hashlib
import json
import struct
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["NO_WRITE", "canonical", "fingerprint", "value_json"]

MOST_BYTES: Final = 4096
MOST_ITEMS: Final = 20_000
MOST_DEPTH: Final = 50
_PREVIEW_KEYS: Final = frozenset(("preview", "bytes", "hash"))
NO_WRITE: Final = 2**32 - 1
"""The writer of a value that was changed in place, without a write."""


def canonical(value: Any) -> str | None:
    """Returns a value as JSON that equal values share, or None if it has no such form."""
    if not _is_json(value, [MOST_ITEMS]):
        return None
    try:
        return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    except (ValueError, TypeError, RecursionError):
        return None


def value_json(value: Any, describe: Callable[[Any], str]) -> str:
    """Returns a value as a recording holds it; `describe` makes the text of a preview."""
    text = canonical(value)
    if text is None:
        return _dump({"preview": describe(value)})
    coded = text.encode("utf-8", "replace")
    if len(coded) <= MOST_BYTES and not _looks_like_preview(value):
        return text
    digest = hashlib.blake2b(coded, digest_size=8).hexdigest()
    return _dump({"preview": describe(value), "bytes": len(coded), "hash": digest})


def fingerprint(
    number: int,
    changed: Iterable[tuple[int, int]],
    flashed: Iterable[tuple[int, int]],
    writes: Iterable[tuple[str, str, str, str | None]],
) -> int:
    """Returns 64 bits of a tick: equal runs have equal ones.

    Args:
        number: the number of the tick.
        changed: uid and status of changed nodes, in order.
        flashed: uid and status of flashed nodes, in order.
        writes: scope, key, type and canonical JSON of each write; a value without it counts by its type.
    """
    digest = hashlib.blake2b(struct.pack("<Q", number), digest_size=8)
    for mark, pairs in ((b"c", changed), (b"f", flashed)):
        digest.update(mark)
        for uid, status in pairs:
            digest.update(struct.pack("<IB", uid, status))
    digest.update(b"w")
    for write in writes:
        digest.update(_dump(list(write)).encode("utf-8", "replace"))
    return int.from_bytes(digest.digest(), "little")


def _dump(value: Any) -> str:
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)


def _looks_like_preview(value: Any) -> bool:
    """Returns whether readers would take a user's dict for a preview."""
    return type(value) is dict and type(value.get("preview")) is str and value.keys() <= _PREVIEW_KEYS


def _is_json(value: Any, left: list[int], depth: int = MOST_DEPTH) -> bool:
    """Returns whether a value is made of JSON's types alone, with bounded items and depth."""
    left[0] -= 1
    if left[0] < 0 or depth < 0:
        return False
    if value is None or type(value) in {bool, int, float, str}:
        return True
    if type(value) in {list, tuple}:
        return all(_is_json(item, left, depth - 1) for item in value)
    if type(value) is dict:
        return all(type(key) is str and _is_json(item, left, depth - 1) for key, item in value.items())
    return False
