"""Values of the blackboard in recordings: canonical JSON, or a preview. Pure."""

from __future__ import annotations

import hashlib
import json
import struct
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["NO_WRITE", "canonical", "fingerprint", "json_of", "value_json"]

MOST_BYTES: Final = 4096
FEW_CHARACTERS: Final = MOST_BYTES // 4
"""A text of so many characters has no more than `MOST_BYTES`."""
MOST_ITEMS: Final = 20_000
MOST_DEPTH: Final = 50
_PREVIEW_KEYS: Final = frozenset(("preview", "bytes", "hash"))
NO_WRITE: Final = 2**32 - 1
"""The writer of a value that was changed in place, without a write."""

_encode: Final = json.JSONEncoder(
    sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False
).encode
_quoted: Final = json.encoder.encode_basestring


def canonical(value: Any) -> str | None:
    """Returns a value as JSON that equal values share, or None if it has no such form."""
    kind = type(value)
    form: str | None = None
    try:
        if kind is str:
            form = _quoted(value)
        elif kind is int:
            form = repr(value)
        elif _is_json(value, [MOST_ITEMS]):
            form = _encode(value)
        if form is not None and not form.isascii():
            form.encode()
    except (ValueError, TypeError, RecursionError):  # NaN, half a character, an integer of 5,000 digits
        return None
    return form


def value_json(value: Any, describe: Callable[[Any], str]) -> str:
    """Returns a value as a recording holds it; `describe` makes the text of a preview."""
    return json_of(value, canonical(value), describe)


def json_of(value: Any, form: str | None, describe: Callable[[Any], str]) -> str:
    """Returns a value as a recording holds it, from its canonical form."""
    if form is None:
        return _dump({"preview": describe(value)})
    if len(form) <= FEW_CHARACTERS and type(value) is not dict:
        return form
    coded = form.encode("utf-8", "replace")
    if len(coded) <= MOST_BYTES and not _looks_like_preview(value):
        return form
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
        digest.update(mark + _packed(list(pairs)))
    digest.update(b"w")
    for write in writes:
        row = ",".join(["null" if text is None else _quoted(text) for text in write])
        digest.update(f"[{row}]".encode("utf-8", "replace"))
    return int.from_bytes(digest.digest(), "little")


def _packed(pairs: list[tuple[int, int]]) -> bytes:
    """Returns pairs as uint32 and uint8 in turns, little-endian; a column at a time, which is fast."""
    if not pairs:
        return b""
    uids, codes = zip(*pairs, strict=True)
    words = struct.pack(f"<{len(uids)}I", *uids)
    data = bytearray(5 * len(uids))
    for place in range(4):
        data[place::5] = words[place::4]
    data[4::5] = bytes(codes)
    return bytes(data)


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
