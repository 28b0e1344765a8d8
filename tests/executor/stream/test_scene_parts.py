"""Scenes without their meshes and textures, as recordings have them."""

from __future__ import annotations

from typing import Any

import msgspec
from hypothesis import given
from hypothesis import strategies as st

from executor.messages import Scene
from executor.stream.scene_parts import without_parts
from executor.stream_messages import Mesh, Texture

encode = msgspec.msgpack.encode
decode = msgspec.msgpack.decode
DATA = st.binary(max_size=40)
MESHES = st.dictionaries(st.text(max_size=5), st.builds(Mesh, DATA, DATA, DATA, DATA), max_size=4)
TEXTURES = st.dictionaries(st.text(max_size=5), st.builds(Texture, DATA, st.just([1.0, 2.0])), max_size=4)


def whole(slim: bytes, parts: dict[str, bytes]) -> Any:
    fields = decode(slim)
    for kind in ("meshes", "textures"):
        fields[kind] = {key: decode(parts[part["hash"]]) for key, part in fields.get(kind, {}).items()}
    return msgspec.convert(fields, Scene)


@given(MESHES, TEXTURES)
def test_with_its_parts_a_scene_is_whole_again(meshes: dict[str, Mesh], textures: dict[str, Texture]) -> None:
    scene = Scene("s", 1.5, [], meshes, [], [1.0, 1.0, 1.0], [], textures)
    slim, parts = without_parts(encode(scene))
    assert whole(slim, parts) == scene
    assert len(parts) == len({encode(part) for part in (*meshes.values(), *textures.values())})
    assert without_parts(slim) == (slim, {})


@given(st.one_of(st.binary(), st.dictionaries(st.text(), st.integers(0, 9) | st.binary()).map(encode)))
def test_what_is_no_scene_stays_as_it_is(data: bytes) -> None:
    assert without_parts(data) == (data, {})
