"""Cameras."""

from __future__ import annotations

import math

import numpy as np
import pytest

from executor.render.interface import Viewpoint, look_at


def test_a_camera_looks_along_x_of_its_pose() -> None:
    view = Viewpoint.of_pose([1, 2, 3, 0, 0, 0, 1], 1.0, 0.1, 10.0)
    assert (view.eye, view.ahead, view.up) == ((1, 2, 3), (1, 0, 0), (0, 0, 1))
    assert np.allclose(view.view_matrix() @ [5, 2, 3, 1], [0, 0, -4, 1])


@pytest.mark.parametrize("target", [[5, 0, 0], [0, 0, -5], [0, 0, 0]])
def test_any_target_gives_a_frame_of_unit_vectors(target: list[float]) -> None:
    view = look_at([0, 0, 0], target)
    assert np.linalg.norm(view.ahead) == pytest.approx(1.0)
    assert np.dot(view.ahead, view.up) == pytest.approx(0.0)
    assert view.roofless


def test_what_is_at_the_edge_of_the_view_is_at_the_edge_of_the_picture() -> None:
    view = Viewpoint.of_pose([0, 0, 0, 0, 0, 0, 1], math.pi / 2, 0.1, 10.0)
    clip = view.projection_matrix(200, 100) @ view.view_matrix() @ [2, -2, 0, 1]
    assert clip[0] / clip[3] == pytest.approx(1.0)
