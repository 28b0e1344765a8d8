"""Reads mesh files (STL, OBJ, DAE, PLY, GLB) into triangles with normals."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np

from executor.messages import Mesh

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

SUFFIXES: Final = (".stl", ".obj", ".dae", ".ply", ".glb")
MAX_BYTES: Final = 50_000_000
MAX_TRIANGLES: Final = 300_000
SHARP_COSINE: Final = 0.77  # edges of more than 40° between faces are shaded sharp


class MeshError(Exception):
    """A mesh cannot be used; the text is the reason."""


def load_mesh(path: Path) -> Mesh:
    """Returns the triangles of all parts of a file as one mesh, in the units of the file.

    Raises:
        MeshError: the file is missing, too large, of an unsupported format, or damaged.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise MeshError(f"meshes of kind {path.suffix or '(none)'} are not read; use {', '.join(SUFFIXES)}")
    if not path.is_file():
        raise MeshError(f"there is no file {path.name}")
    if path.stat().st_size > MAX_BYTES:
        raise MeshError(f"{path.name} is larger than {MAX_BYTES // 1_000_000} MB")
    found = _triangles(path)
    if not len(found.faces):
        raise MeshError(f"{path.name} has no triangles")
    if len(found.faces) > MAX_TRIANGLES:
        raise MeshError(f"{path.name} has {len(found.faces)} triangles; {MAX_TRIANGLES} are the most")
    if not np.isfinite(found.vertices).all():
        raise MeshError(f"{path.name} has vertices that are no numbers")
    corners, order = _shaded(found.vertices, found.faces, found.uvs)
    return Mesh(
        corners[:, :3].astype("<f4").tobytes(),
        corners[:, 3:6].astype("<f4").tobytes(),
        order.astype("<u4").tobytes(),
        corners[:, 6:].astype("<f4").tobytes(),
    )


def _shaded(
    points: NDArray[np.float64], faces: NDArray[np.int64], uvs: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Returns rows of point, normal and uv, and the faces as rows of indices.

    Normals are smooth on round surfaces, and sharp at edges.
    """
    _, place = np.unique(np.round(points, 6), axis=0, return_inverse=True)
    across = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    flat = _unit(across)
    summed = np.zeros_like(points)
    np.add.at(summed, place.ravel()[faces].ravel(), np.repeat(across, 3, axis=0))
    round_ones = _unit(summed)[place.ravel()[faces]]
    own = np.repeat(flat[:, None, :], 3, axis=1)
    is_sharp = (round_ones * own).sum(axis=2, keepdims=True) < SHARP_COSINE
    columns = [points[faces], np.where(is_sharp, own, round_ones), uvs[faces]]
    rows = np.concatenate(columns, axis=2).reshape(-1, 6 + uvs.shape[1])
    corners, order = np.unique(np.round(rows, 6), axis=0, return_inverse=True)
    return corners, order.reshape(-1, 3)


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


class _Found(NamedTuple):
    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    uvs: NDArray[np.float64]


def _triangles(path: Path) -> _Found:
    """Reads a file and merges its parts; the mesh library could merge them too, but needs Pillow for that."""
    import trimesh  # noqa: PLC0415 - slow to load, and few robots have meshes

    try:
        loaded: Any = trimesh.load(path, process=False, skip_materials=True)
        if isinstance(loaded, trimesh.Trimesh):
            parts = [_part(loaded, np.eye(4))]
        elif isinstance(loaded, trimesh.Scene):
            placed = [loaded.graph[node] for node in loaded.graph.nodes_geometry]
            found = [(loaded.geometry[name], matrix) for matrix, name in placed]
            parts = [_part(mesh, matrix) for mesh, matrix in found if isinstance(mesh, trimesh.Trimesh)]
        else:
            parts = []
    except Exception as error:  # parsers may raise any error on malformed files
        raise MeshError(f"{path.name} cannot be read: {error}") from error
    if not parts:
        raise MeshError(f"{path.name} has no triangles")
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    have_uvs = all(part.uvs.shape[1] for part in parts)
    return _Found(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=False)]),
        np.concatenate([part.uvs if have_uvs else part.uvs[:, :0] for part in parts]),
    )


def _part(mesh: Any, matrix: NDArray[np.float64]) -> _Found:
    points = np.asarray(mesh.vertices, np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
    faces = np.asarray(mesh.faces, np.int64)
    if np.linalg.det(matrix[:3, :3]) < 0:  # a reflection inverts triangles
        faces = faces[:, ::-1]
    uvs = getattr(mesh.visual, "uv", None)
    if uvs is None or np.shape(uvs) != (len(points), 2) or not np.isfinite(uvs).all():
        uvs = np.zeros((len(points), 0))
    return _Found(points, faces, np.asarray(uvs, np.float64))
