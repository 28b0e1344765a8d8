"""Takes the meshes and textures out of a recorded scene, so that a recording holds each of them once. Pure.

In a recording, `meshes` and `textures` of a frame `scene` have `{"hash": H}` in place of each part; the part
itself, in MessagePack as the stream has it, is the attachment `scene/H`.
"""

from __future__ import annotations

import hashlib
from typing import Any, Final

import msgspec

__all__ = ["PREFIX", "without_parts"]

PREFIX: Final = "scene/"
"""Begins the names of attachments with parts of scenes."""
_KINDS: Final = ("meshes", "textures")
_encode = msgspec.msgpack.Encoder().encode
_decode = msgspec.msgpack.Decoder().decode


def without_parts(scene: bytes) -> tuple[bytes, dict[str, bytes]]:
    """Returns a scene without its parts, and the parts by their hash; other frames are returned unchanged."""
    try:
        fields: Any = _decode(scene)
    except (msgspec.DecodeError, RecursionError, UnicodeDecodeError):
        return scene, {}
    parts: dict[str, bytes] = {}
    if not isinstance(fields, dict):
        return scene, {}
    for kind in _KINDS:
        if isinstance(fields.get(kind), dict):
            fields[kind] = {key: _named(part, parts) for key, part in fields[kind].items()}
    return (_encode(fields), parts) if parts else (scene, {})


def _named(part: Any, parts: dict[str, bytes]) -> Any:
    if not isinstance(part, dict) or "hash" in part:
        return part
    data = _encode(part)
    digest = hashlib.blake2b(data, digest_size=16).hexdigest()
    parts[digest] = data
    return {"hash": digest}
