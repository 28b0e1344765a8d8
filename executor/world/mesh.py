"""Reads mesh files (STL, OBJ, DAE, PLY, GLB) into triangles with normals."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from executor.messages import Mesh

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

SUFFIXES: Final = (".stl", ".obj", ".dae", ".ply", ".glb")
MAX_BYTES: Final = 50_000_000
MAX_TRIANGLES: Final = 300_000
SHARP_COSINE: Final = 0.77  # an edge of more than 40° between faces is drawn as one


class MeshError(Exception):
    """A mesh that cannot be used; the text says why."""


def load_mesh(path: Path) -> Mesh:
    """Returns the triangles of a file, all its parts in one, in the file's own units.

    Raises:
        MeshError: it is missing, too large, of a kind that we do not read, or broken.
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
    corners, order = _shaded(np.asarray(found.vertices, np.float64), np.asarray(found.faces, np.int64))
    return Mesh(
        corners[:, :3].astype("<f4").tobytes(),
        corners[:, 3:].astype("<f4").tobytes(),
        order.astype("<u4").tobytes(),
    )


def _shaded(
    points: NDArray[np.float64], faces: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Returns rows of point and normal, and the faces by row: smooth where it is round, sharp at edges."""
    _, place = np.unique(np.round(points, 6), axis=0, return_inverse=True)
    across = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    flat = _unit(across)
    summed = np.zeros_like(points)
    np.add.at(summed, place.ravel()[faces].ravel(), np.repeat(across, 3, axis=0))
    round_ones = _unit(summed)[place.ravel()[faces]]
    own = np.repeat(flat[:, None, :], 3, axis=1)
    is_sharp = (round_ones * own).sum(axis=2, keepdims=True) < SHARP_COSINE
    rows = np.concatenate([points[faces], np.where(is_sharp, own, round_ones)], axis=2).reshape(-1, 6)
    corners, order = np.unique(np.round(rows, 6), axis=0, return_inverse=True)
    return corners, order.reshape(-1, 3)


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit: NDArray[np.float64] = np.where(lengths > 0, vectors / np.maximum(lengths, 1e-30), [0.0, 0.0, 1.0])
    return unit


def write_obj(mesh: Mesh, path: Path) -> None:
    """Writes a mesh as the physics reads it."""
    points = np.frombuffer(mesh.positions, "<f4").reshape(-1, 3)
    faces = np.frombuffer(mesh.indices, "<u4").reshape(-1, 3) + 1
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in points.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in faces.tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def _triangles(path: Path) -> Any:
    import trimesh  # noqa: PLC0415 - slow to load, and few robots have meshes

    try:
        loaded = trimesh.load(path, force="mesh", process=False, skip_materials=True)
    except Exception as error:  # whatever a parser of hostile files raises
        raise MeshError(f"{path.name} cannot be read: {error}") from error
    if not isinstance(loaded, trimesh.Trimesh):
        raise MeshError(f"{path.name} has no triangles")
    return loaded
