"""Reads mesh files (STL, OBJ, DAE, PLY, GLB, glTF) into triangles with normals."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from executor.messages import Mesh
from executor.world.geometry.collada import Part, load_collada
from executor.world.geometry.companions import Companions
from executor.world.geometry.mesh_colors import (
    MOST_COLORS,
    SiblingMaterials,
    face_colors,
    gltf_colors,
    names_materials,
)

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

    from executor.world.geometry.mesh_colors import Rgba

SUFFIXES: Final = (".stl", ".obj", ".dae", ".ply", ".glb", ".gltf")
MAX_BYTES: Final = 50_000_000
MAX_TRIANGLES: Final = 300_000
SHARP_COSINE: Final = 0.77  # edges of more than 40° between faces are shaded sharp


class MeshError(Exception):
    """A mesh cannot be used; the text is the reason."""


@dataclass(frozen=True)
class ColoredMesh:
    """The triangles of a file as one mesh, and as one for each of its colours.

    `parts` is empty if the file has no colours; triangles without one have the colour None. `note` says why
    colours that the file names are not shown.
    """

    whole: Mesh
    parts: tuple[tuple[Rgba | None, Mesh], ...] = ()
    note: str = ""


def load_mesh(path: Path) -> Mesh:
    """Returns the triangles of all parts of a file as one mesh, as `load_colored` does."""
    return load_colored(path).whole


def load_colored(path: Path, may_read: Callable[[Path], bool] | None = None) -> ColoredMesh:
    """Returns the triangles of all parts of a file, with its colours.

    Lengths are in the units of the file; those of COLLADA, which names its unit, are in m.

    Args:
        path: the file.
        may_read: says which files that it names may be read; those beside and below it if it is None.

    Raises:
        MeshError: the file is missing, too large, of an unsupported format, or damaged.
    """
    found = load_triangles(path, may_read=may_read)
    if len(found.faces) > MAX_TRIANGLES:
        raise MeshError(f"{path.name} has {len(found.faces)} triangles; {MAX_TRIANGLES} are the most")
    corners, order = _shaded(found.vertices, found.faces, found.uvs)
    colors = list(dict.fromkeys(found.colors))
    if len(colors) > MOST_COLORS:
        note = f"{path.name} has {len(colors)} colours: it is shown in one, since {MOST_COLORS} are the most"
        return ColoredMesh(_mesh(corners, order), note=note)
    if colors in ([], [None]):
        note = f"the materials of {path.name} cannot be read" if names_materials(path) else ""
        return ColoredMesh(_mesh(corners, order), note=note)
    index = {color: number for number, color in enumerate(colors)}
    numbers = np.array([index[color] for color in found.colors])
    faces = order.reshape(-1, 3)
    parts = []
    for number, color in enumerate(colors):
        kept, own = np.unique(faces[numbers == number], return_inverse=True)
        parts.append((color, _mesh(corners[kept], own.ravel())))
    return ColoredMesh(_mesh(corners, order), tuple(parts))


def _mesh(corners: NDArray[np.float64], order: NDArray[np.int64]) -> Mesh:
    return Mesh(
        corners[:, :3].astype("<f4").tobytes(),
        corners[:, 3:6].astype("<f4").tobytes(),
        order.astype("<u4").tobytes(),
        corners[:, 6:].astype("<f4").tobytes(),
    )


def load_triangles(path: Path, part: str = "", may_read: Callable[[Path], bool] | None = None) -> Part:
    """Returns the triangles of a file, or of its parts of that name, however many.

    Raises:
        MeshError: the file is missing, too large, of an unsupported format, or damaged, or has no such part.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise MeshError(f"meshes of kind {path.suffix or '(none)'} are not read; use {', '.join(SUFFIXES)}")
    if not path.is_file():
        raise MeshError(f"there is no file {path.name}")
    if path.stat().st_size > MAX_BYTES:
        raise MeshError(f"{path.name} is larger than {MAX_BYTES // 1_000_000} MB")
    found = _triangles(path, part, may_read)
    if not len(found.faces):
        raise MeshError(f"{path.name} has no triangles")
    if not np.isfinite(found.vertices).all():
        raise MeshError(f"{path.name} has vertices that are no numbers")
    return found


def _shaded(
    points: NDArray[np.float64], faces: NDArray[np.int64], uvs: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Returns rows of point, normal and uv, and the faces as rows of indices.

    Normals are smooth on round surfaces, and sharp at edges.
    """
    _, place = unique_rows(np.round(points, 6))
    across = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    flat = _unit(across)
    summed = np.zeros_like(points)
    np.add.at(summed, place[faces].ravel(), np.repeat(across, 3, axis=0))
    round_ones = _unit(summed)[place[faces]]
    own = np.repeat(flat[:, None, :], 3, axis=1)
    is_sharp = (round_ones * own).sum(axis=2, keepdims=True) < SHARP_COSINE
    columns = [points[faces], np.where(is_sharp, own, round_ones), uvs[faces]]
    rows = np.concatenate(columns, axis=2).reshape(-1, 6 + uvs.shape[1])
    corners, order = unique_rows(np.round(rows, 6))
    return corners, order.reshape(-1, 3)


def unique_rows(rows: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Returns the different rows in lexicographic order, and the place of each row among them.

    As `numpy.unique` does, in a third of its time.
    """
    order = np.lexsort(rows.T[::-1])
    ordered = rows[order]
    is_new = np.ones(len(rows), bool)
    is_new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    place = np.empty(len(rows), np.int64)
    place[order] = np.cumsum(is_new) - 1
    return ordered[is_new], place


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit: NDArray[np.float64] = np.where(lengths > 0, vectors / np.maximum(lengths, 1e-30), [0.0, 0.0, 1.0])
    return unit


def write_obj(mesh: Mesh, path: Path) -> None:
    """Writes a mesh as an OBJ file for the physics engine."""
    points = np.frombuffer(mesh.positions, "<f4").reshape(-1, 3)
    faces = np.frombuffer(mesh.indices, "<u4").reshape(-1, 3) + 1
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in points.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in faces.tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def _triangles(path: Path, part: str, may_read: Callable[[Path], bool] | None) -> Part:
    """Reads a file and merges its parts; the mesh library could merge them too, but needs Pillow for that."""
    try:
        if path.suffix.lower() == ".dae":
            parts = load_collada(path.read_bytes(), Companions(path, may_read).read)
        else:
            parts = _load(path, part, may_read)
    except Exception as error:  # parsers may raise any error on malformed files
        raise MeshError(f"{path.name} cannot be read: {error}") from error
    if not parts:
        raise MeshError(f"{path.name} has no triangles")
    if part:
        parts = [each for each in parts if part in each.names]
        if not parts:
            raise MeshError(f"{path.name} has no part {part!r}")
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    have_uvs = all(part.uvs.shape[1] for part in parts)
    return Part(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=False)]),
        np.concatenate([part.uvs if have_uvs else part.uvs[:, :0] for part in parts]),
        colors=[color for part in parts for color in (part.colors or [None] * len(part.faces))],
    )


def _load(path: Path, part: str, may_read: Callable[[Path], bool] | None) -> list[Part]:
    import trimesh  # noqa: PLC0415 - slow to load, and few robots have meshes

    options: dict[str, Any] = {"skip_materials": True}
    if path.suffix.lower() == ".obj":
        options = {"resolver": SiblingMaterials(path, may_read), "split_objects": bool(part)}
    files = Companions(path, may_read)
    if path.suffix.lower() == ".gltf":
        options["resolver"] = files
    loaded: Any = trimesh.load(path, process=False, **options)
    if isinstance(loaded, trimesh.Trimesh):
        return [_part(loaded, np.eye(4))]
    if not isinstance(loaded, trimesh.Scene):
        return []
    painted = _painted(path, loaded, files)
    placed = [(str(node), *loaded.graph[node]) for node in loaded.graph.nodes_geometry]
    found = [(loaded.geometry[name], matrix, (node, str(name))) for node, matrix, name in placed]
    return [
        _part(mesh, matrix, painted.get(names[1]))._replace(names=names)
        for mesh, matrix, names in found
        if isinstance(mesh, trimesh.Trimesh)
    ]


def _painted(path: Path, loaded: Any, files: Companions) -> dict[str, Rgba | None]:
    """Returns the colours of a glTF file's meshes by their names; its reader needs Pillow for them."""
    if path.suffix.lower() not in (".glb", ".gltf"):
        return {}
    try:
        colors = gltf_colors(path.read_bytes(), files)
    except (ValueError, KeyError, IndexError, TypeError, struct.error):  # the colours are lost alone
        return {}
    return dict(zip(loaded.geometry, colors, strict=True)) if len(colors) == len(loaded.geometry) else {}


def _part(mesh: Any, matrix: NDArray[np.float64], color: Rgba | None = None) -> Part:
    points = np.asarray(mesh.vertices, np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
    faces = np.asarray(mesh.faces, np.int64)
    if np.linalg.det(matrix[:3, :3]) < 0:  # a reflection inverts triangles
        faces = faces[:, ::-1]
    uvs = getattr(mesh.visual, "uv", None)
    if uvs is None or np.shape(uvs) != (len(points), 2) or not np.isfinite(uvs).all():
        uvs = np.zeros((len(points), 0))
    colors = [color] * len(faces) if color is not None else face_colors(mesh)
    return Part(points, faces, np.asarray(uvs, np.float64), colors=colors)
