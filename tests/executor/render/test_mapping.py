"""Texture coordinates of shapes."""

from __future__ import annotations

import numpy as np
import pytest

from executor.render.geometry import box, capsule, cylinder
from executor.render.mapping import coordinates


def test_a_box_of_one_metre_has_its_tiles_once_a_tile() -> None:
    vertices = box()
    uvs = coordinates("box", vertices[:, :3], vertices[:, 3:], (0.5, 0.25))
    assert uvs.min() == pytest.approx(0.0)
    assert uvs[:, 0].max() == pytest.approx(2.0)
    assert uvs[:, 1].max() == pytest.approx(4.0)


@pytest.mark.parametrize(("kind", "vertices"), [("cylinder", cylinder()), ("sphere", capsule(1.0, 0.0))])
def test_round_shapes_are_wrapped_a_whole_number_of_times(kind: str, vertices: np.ndarray) -> None:
    uvs = coordinates(kind, vertices[:, :3], vertices[:, 3:], (1.0, 1.0))
    assert np.isfinite(uvs).all()
    side = np.abs(vertices[:, 5]) < 0.5
    assert np.ptp(uvs[side, 0]) >= 5.0
