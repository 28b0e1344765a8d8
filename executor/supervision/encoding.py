"""Writes messages as MessagePack, whatever a user's value has put into them. Pure."""

from __future__ import annotations

import dataclasses
from typing import Any, Final

import msgspec

from tree_gardener.descriptions import readable, text_of

__all__ = ["encode_message"]

_PLAIN: Final[tuple[Any, ...]] = (str, float, int, bytes)
_DEPTH: Final = 100


def encode_message(message: msgspec.Struct) -> bytes:
    """Returns the bytes of a message.

    Values of derived classes are sent as what they derive from, others as a text that describes them.
    """
    try:
        return _encode(message)
    except (UnicodeEncodeError, OverflowError, RecursionError):
        return _encode(_sendable(message, 0))


def _stand_in(value: Any) -> Any:
    """Returns what is sent instead of a value that has no form in MessagePack."""
    kind = type(value)
    for base in _PLAIN:
        if issubclass(kind, base):
            return base.__new__(base, base.__getnewargs__(value)[0])
    return text_of(value)


_encode: Final = msgspec.msgpack.Encoder(enc_hook=_stand_in).encode


def _sendable(value: Any, depth: int) -> Any:
    """Returns a copy of a message without half characters, integers above 64 bits, and rings."""
    if depth > _DEPTH:
        return "…"
    kind = type(value)
    below = depth + 1
    if issubclass(kind, msgspec.Struct):
        fields = {name: _sendable(getattr(value, name), below) for name in kind.__struct_fields__}
        sent: Any = msgspec.structs.replace(value, **fields)
    elif issubclass(kind, str):
        sent = readable(str.__str__(value))
    elif issubclass(kind, dict):
        sent = {_sendable(key, below): _sendable(each, below) for key, each in dict.items(value)}
    elif issubclass(kind, (list, tuple)):
        sent = [_sendable(each, below) for each in value]
    else:
        is_large = issubclass(kind, int) and not -(2**63) <= int.__int__(value) < 2**64
        sent = text_of(value) if is_large or dataclasses.is_dataclass(kind) else value
    return sent
