"""The parts of a scene that a renderer draws."""

from __future__ import annotations

import math

import numpy as np

from executor.render.pieces import matrices


def test_a_pose_becomes_a_matrix() -> None:
    half = math.sqrt(0.5)
    poses = np.array([[0, 0, 0, 0, 0, 0, 1], [1, 2, 3, 0, 0, half, half]], np.float32)
    rows = matrices(poses)
    still, turned = rows.reshape(2, 3, 4)
    assert np.allclose(still, np.eye(4)[:3])
    point = np.array([1, 0, 0, 1], np.float32)
    assert np.allclose(turned @ point, [1, 3, 3], atol=1e-5)
