"""Copies the meshes that an imported world names into the project: checked, cut to a part, made smaller."""

from __future__ import annotations

import contextlib
import posixpath
import re
import tempfile
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from executor.sdf.includes import file_of
from executor.sdf.values import is_true, numbers, text_of
from executor.world.geometry.companions import bundle, has_room
from executor.world.geometry.mesh import MAX_TRIANGLES, SUFFIXES, MeshError, load_triangles
from tree_gardener.packages import PackageError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from lxml import etree
    from numpy.typing import NDArray

    from executor.sdf.files import Files

BIGGEST: Final = 2_000_000
"""Meshes of more triangles are not made smaller."""


class _Cut(NamedTuple):
    """A part of a file or, if `name` is "", all of it; moved to its middle; mirrored."""

    source: str
    name: str
    is_centred: bool
    x: bool
    y: bool
    z: bool


class Meshes:
    """The meshes of a project that is being made.

    Attributes:
        files: their contents, by their paths in the project.

    Args:
        files: where they are read from.
        folder: the folder of the project that gets them.
        skip: is called with each that is left out, and the reason.
        simplify: whether a mesh of too many triangles is made smaller.
    """

    def __init__(
        self,
        files: Files,
        folder: str,
        skip: Callable[[etree._Element, str], None],
        *,
        simplify: bool = False,
    ) -> None:
        self.files: dict[str, bytes] = {}
        self._from = files
        self._folder = folder
        self._skip = skip
        self._simplify = simplify
        self._made: dict[_Cut, str | None] = {}

    def add(self, shape: etree._Element) -> tuple[str, list[float]] | None:
        """Copies the mesh of a `<mesh>`; returns its path in the project and its scale, None if left out."""
        uri = text_of(shape, "uri") or text_of(shape, "filename")
        scale = numbers(shape, "scale", 3, file_of(shape))
        part = shape.find("submesh")
        name = "" if part is None else text_of(part, "name")
        is_centred = part is not None and is_true(part, "center")
        signs = (value < 0 for value in scale)
        try:
            source = self._from.find(uri, file_of(shape))
        except PackageError as error:
            self._skip(shape, f"the mesh {uri} is left out: {error}")
            return None
        cut = _Cut(source, name, is_centred, *signs)
        if cut not in self._made:
            self._made[cut] = self._copied(shape, uri, cut)
        path = self._made[cut]
        return None if path is None else (path, [abs(value) for value in scale])

    def write(self, name: str, points: NDArray[np.float64], faces: NDArray[np.int64]) -> str:
        """Adds triangles as a file, and returns its path."""
        path = self._free(f"{name}.stl")
        self.files[path] = stl(points, faces)
        return path

    def _copied(self, shape: etree._Element, uri: str, cut: _Cut) -> str | None:
        source, name, is_centred, *mirrored = cut
        data = self._from.read(source)
        stem, suffix = posixpath.splitext(posixpath.basename(source))
        if data is None:
            self._skip(shape, f"the mesh {uri} is left out: there is no such file in what is imported")
            return None
        try:
            if suffix.lower() not in SUFFIXES:
                raise MeshError(f"meshes of kind {suffix} are not read; use {', '.join(SUFFIXES)}")
            points, faces = _read(data, f"{stem}{suffix.lower()}", name, self._beside(source))
        except MeshError as error:
            self._skip(shape, f"the mesh {uri} is left out: {error}")
            return None
        if len(faces) > MAX_TRIANGLES:
            if not self._simplify or len(faces) > BIGGEST:
                hint = "; import again with simplify" if len(faces) <= BIGGEST else ""
                text = f"it has {len(faces)} triangles; {MAX_TRIANGLES} are the most{hint}"
                self._skip(shape, f"the mesh {uri} is left out: {text}")
                return None
            before = len(faces)
            points, faces = simplified(points, faces, MAX_TRIANGLES)
            self._skip(shape, f"the mesh {uri} had {before} triangles; it has {len(faces)} now")
        elif not name and not any(mirrored):
            file = f"{stem}{suffix.lower()}"
            beside = bundle(file, data, self._beside(source))
            path = self._free(file, beside)
            self.files[path] = data
            self.files |= {f"{posixpath.dirname(path)}/{own}": content for own, content in beside.items()}
            return path
        if is_centred:
            points = points - (points.min(axis=0) + points.max(axis=0)) / 2
        turn = np.array([-1.0 if sign else 1.0 for sign in mirrored])
        if turn.prod() < 0:
            faces = faces[:, ::-1]
        return self.write(f"{stem}_{name}" if name else stem, points * turn, faces)

    def _beside(self, source: str) -> Callable[[str], bytes | None]:
        """Returns what reads the files that a mesh names: where it says, or beside it by their names."""

        def read(name: str) -> bytes | None:
            for wanted in dict.fromkeys((name, posixpath.basename(name))):
                with contextlib.suppress(PackageError, ValueError, OSError):
                    data = self._from.read(self._from.find(wanted, source))
                    if data is not None:
                        return data
            return None

        return read

    def _free(self, name: str, beside: Mapping[str, bytes] = MappingProxyType({})) -> str:
        """Returns a path that is not taken; in a separate folder if files lie beside it."""
        stem, suffix = posixpath.splitext(
            re.sub(r"[^A-Za-z0-9._-]+", "_", name)[-80:].lstrip("._-") or "mesh.stl"
        )
        number = 1
        while True:
            own = stem if number == 1 else f"{stem}_{number}"
            path = (
                f"{self._folder}/meshes/{own}/{stem}{suffix}"
                if beside
                else f"{self._folder}/meshes/{own}{suffix}"
            )
            if has_room(path, beside, self.files):
                return path
            number += 1


def _read(
    data: bytes, file: str, name: str, beside: Callable[[str], bytes | None]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Returns points and triangles of a file, or of its part of that name."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / file
        path.write_bytes(data)
        if path.suffix == ".gltf":
            for own, content in bundle(file, data, beside).items():
                (path.parent / own).write_bytes(content)
        found = load_triangles(path, name)
    return found.vertices, found.faces


def simplified(
    points: NDArray[np.float64], faces: NDArray[np.int64], most: int
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Joins the points that lie in one cell of a grid, with cells that grow until few triangles are left."""
    low = points.min(axis=0)
    length = float((points.max(axis=0) - low).max()) or 1.0
    cells = max(int(most**0.5), 2)  # of a plane, so many cells make so many triangles twice
    while True:
        grid = np.floor((points - low) / (length / cells)).astype(np.int64)
        _, first, place = np.unique(grid, axis=0, return_index=True, return_inverse=True)
        joined = place.ravel()[faces]
        a, b, c = joined.T
        kept = joined[(a != b) & (b != c) & (a != c)]
        _, rows = np.unique(np.sort(kept, axis=1), axis=0, return_index=True)
        kept = kept[np.sort(rows)]
        if len(kept) <= most or cells <= 2:
            return points[first], kept
        cells = cells * 3 // 4


def stl(points: NDArray[np.float64], faces: NDArray[np.int64]) -> bytes:
    """Returns triangles as a binary STL file."""
    rows = np.zeros(len(faces), np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]))
    rows["corners"] = points[faces]
    return bytes(80) + np.uint32(len(faces)).tobytes() + rows.tobytes()
