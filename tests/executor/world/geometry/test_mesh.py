"""Files of meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from executor.world.geometry import mesh
from executor.world.geometry.mesh import MeshError, load_mesh, unique_rows, write_obj

if TYPE_CHECKING:
    from pathlib import Path

CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + (
    "f 1 2 4\nf 1 4 3\nf 5 7 8\nf 5 8 6\nf 1 5 6\nf 1 6 2\nf 3 4 8\n"
    "f 3 8 7\nf 1 3 7\nf 1 7 5\nf 2 6 8\nf 2 8 4\n"
)


def test_a_cube_has_sharp_edges_and_reads_back(tmp_path: Path) -> None:
    (tmp_path / "cube.obj").write_text(CUBE)
    found = load_mesh(tmp_path / "cube.obj")
    normals = np.frombuffer(found.normals, "<f4").reshape(-1, 3)
    assert len(normals) > 8, "edges are sharp: a corner has several normals"
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-4)
    write_obj(found, tmp_path / "again.obj")
    assert len(load_mesh(tmp_path / "again.obj").indices) == len(found.indices)


def test_rows_are_found_as_numpy_finds_them() -> None:
    rows = np.random.default_rng(1).integers(-2, 3, (500, 4)).astype(np.float64)
    unique, place = unique_rows(rows)
    expected, inverse = np.unique(rows, axis=0, return_inverse=True)
    assert (unique == expected).all()
    assert (place == inverse.ravel()).all()


def test_what_cannot_be_used_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.obj").write_text("nonsense")
    (tmp_path / "cube.obj").write_text(CUBE)
    monkeypatch.setattr(mesh, "MAX_TRIANGLES", 3)
    for name, message in (
        ("a.step", "are not read"),
        ("no.obj", "there is no file"),
        ("a.obj", "no triangles|cannot be read"),
        ("cube.obj", "12 triangles; 3 are the most"),
    ):
        with pytest.raises(MeshError, match=message):
            load_mesh(tmp_path / name)
