"""Reads the colours of mesh files: materials of OBJ and glTF, faces of binary STL, vertices of PLY and glTF.

A colour that cannot be read is None: the mesh keeps its shape, and the colour of who uses it.
"""

from __future__ import annotations

import base64
import json
import re
import struct
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from executor.world.geometry.companions import Companions, gltf_tree, named_files
from executor.world.geometry.pictures import mean_color

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

__all__ = ["MOST_COLORS", "Rgba", "SiblingMaterials", "face_colors", "gltf_colors", "names_materials"]

Rgba = tuple[float, float, float, float]
MOST_COLORS: Final = 64
"""Of one mesh; one with more, as of a scan, is shown in the colour of who uses it."""
MOST_MATERIAL_BYTES: Final = 1_000_000
_JSON: Final = 0x4E4F534A
_TRIANGLES: Final = (4, 5, 6)
_VALID: Final = 0x8000


class SiblingMaterials(Companions):
    """Reads the files of materials of an OBJ, and nothing else; a picture has its mean colour."""

    def __init__(self, path: Path, may_read: Callable[[Path], bool] | None = None) -> None:
        super().__init__(path, may_read, (".mtl",))
        self._pictures = Companions(path, may_read)

    def get(self, name: str) -> bytes:
        """Returns a file of materials.

        Raises:
            OSError: it is none, or may not be read.
        """
        data = super().get(name)
        if len(data) > MOST_MATERIAL_BYTES:
            raise FileNotFoundError(name)
        return b"\n".join(self._painted(block) for block in re.split(rb"(?m)^(?=[ \t]*newmtl\b)", data))

    __getitem__ = get

    def _painted(self, block: bytes) -> bytes:
        pictures = named_files("a.mtl", block)
        data = self._pictures.read(pictures[0]) if pictures else None
        color = None if data is None else mean_color(data)
        return block if color is None else block + "\nKd {} {} {}\n".format(*color).encode()


def names_materials(path: Path) -> bool:
    """Returns whether a mesh file uses materials, however little of them can be read."""
    mark = {
        ".obj": b"usemtl ",
        ".glb": b'"material"',
        ".gltf": b'"material"',
        ".dae": b"<instance_material",
    }.get(path.suffix.lower())
    return mark is not None and mark in path.read_bytes()


def gltf_colors(data: bytes, files: Companions) -> list[Rgba | None]:
    """Returns the colour of each primitive of triangles of a glTF, in the order of the file.

    Args:
        data: a `.gltf` or `.glb` file.
        files: those that it names.
    """
    tree, chunk = _parts(data)
    pictures = _Pictures(tree, chunk, files)
    materials = [_of_gltf(each, pictures) for each in tree.get("materials", ())]
    found: list[Rgba | None] = []
    for mesh in tree.get("meshes", ()):
        for primitive in mesh["primitives"]:
            if primitive.get("mode", 4) in _TRIANGLES:
                index = primitive.get("material")
                found.append(None if index is None else materials[index])
    return found


def _parts(data: bytes) -> tuple[dict[str, Any], bytes]:
    """Returns the document of a glTF, and the buffer in the file."""
    if not data.startswith(b"glTF"):
        return gltf_tree(data), b""
    length, kind = struct.unpack_from("<II", data, 12)
    return (json.loads(data[20 : 20 + length]), data[28 + length :]) if kind == _JSON else ({}, b"")


class _Pictures:
    """The mean colours of the pictures in a glTF."""

    def __init__(self, tree: dict[str, Any], chunk: bytes, files: Companions) -> None:
        self._tree = tree
        self._chunk = chunk
        self._files = files

    def mean(self, texture: dict[str, Any]) -> tuple[float, float, float] | None:
        """Returns the mean colour of a texture's picture; None if it cannot be read."""
        source = self._tree["textures"][texture["index"]].get("source")
        data = None if source is None else self._bytes(self._tree["images"][source])
        return None if data is None else mean_color(data)

    def _bytes(self, thing: dict[str, Any]) -> bytes | None:
        uri = thing.get("uri")
        if uri is None and "bufferView" in thing:
            view = self._tree["bufferViews"][thing["bufferView"]]
            buffer = self._tree["buffers"][view["buffer"]]
            whole = self._bytes(buffer) if "uri" in buffer else self._chunk
            start = view.get("byteOffset", 0)
            return None if whole is None else whole[start : start + view["byteLength"]]
        if isinstance(uri, str) and uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        return None if uri is None else self._files.read(uri)


def _of_gltf(material: dict[str, Any], pictures: _Pictures) -> Rgba | None:
    surface = material.get("pbrMetallicRoughness", {})
    mean: tuple[float, float, float] | None = (1.0, 1.0, 1.0)
    if "baseColorTexture" in surface:
        mean = pictures.mean(surface["baseColorTexture"])
    if mean is None:
        return None
    red, green, blue, alpha = (float(value) for value in surface.get("baseColorFactor", (1, 1, 1, 1)))
    opaque = material.get("alphaMode", "OPAQUE") != "BLEND"
    shown = (_shown(value) * part for value, part in zip((red, green, blue), mean, strict=True))
    return _rgba([*shown, 1.0 if opaque else alpha])


def _shown(linear: float) -> float:
    """Returns a channel of glTF, which is linear, as sRGB."""
    return round(12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055, 6)


def face_colors(mesh: Any) -> list[Rgba | None]:
    """Returns the colour of each face of a mesh that `trimesh` has read; none at all if it has none."""
    material = getattr(mesh.visual, "material", None)
    if material is not None:
        if getattr(material, "image", None) is not None or "diffuse" not in vars(material):
            return []
        return [_rgba(np.asarray(material.diffuse, float) / 255)] * len(mesh.faces)
    if mesh.visual.kind in ("vertex", "face"):
        return _as_tuples(np.asarray(mesh.visual.face_colors, float) / 255)
    marks = mesh.face_attributes.get("stl")
    return [] if marks is None else _of_stl(np.asarray(marks), str(mesh.metadata.get("header", "")))


def _of_stl(marks: NDArray[Any], header: str) -> list[Rgba | None]:
    """Reads five bits a channel, as VisCAM (blue lowest, top bit set) or Materialise (red lowest, clear)."""
    channels = np.stack([(marks >> shift) & 31 for shift in (0, 5, 10)], axis=1) / 31.0
    is_marked = (marks & _VALID) != 0
    if "COLOR=" in header:
        is_marked = ~is_marked
    else:
        channels = channels[:, ::-1]
    if not is_marked.any():
        return []
    tuples = _as_tuples(np.concatenate([channels, np.ones((len(channels), 1))], axis=1))
    return [color if marked else None for color, marked in zip(tuples, is_marked.tolist(), strict=True)]


def _as_tuples(colors: NDArray[np.float64]) -> list[Rgba | None]:
    return [_rgba(row) for row in np.round(colors, 3).tolist()]


def _rgba(values: Any) -> Rgba | None:
    row = [min(max(float(value), 0.0), 1.0) for value in values]
    return (row[0], row[1], row[2], row[3]) if len(row) == 4 and np.isfinite(row).all() else None
