"""Triangles of primitive shapes."""

from __future__ import annotations

import numpy as np
import pytest

from executor.render import geometry


@pytest.mark.parametrize(
    ("vertices", "radius"),
    [(geometry.box(), 0.75**0.5), (geometry.cylinder(), 1.25**0.5), (geometry.capsule(0.5, 2.0), 1.5)],
)
def test_normals_are_of_unit_length_and_point_outwards(vertices: geometry.Vertices, radius: float) -> None:
    points, normals = vertices[:, :3], vertices[:, 3:]
    assert len(vertices) % 3 == 0
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-6)
    assert (np.sum(points * normals, axis=1) >= -1e-6).all()
    assert np.linalg.norm(points, axis=1).max() == pytest.approx(radius, abs=1e-5)


def test_indices_give_the_same_triangles_without_empty_ones() -> None:
    unique, order = geometry.indexed(geometry.box())
    assert len(unique) == 24
    assert len(order) == 36
    assert len(geometry.grid(3)) == 9 * 6
