"""The shadow map is redrawn only where something moved."""

import numpy as np
import pytest
from numpy.typing import NDArray

from executor.messages import Light, Scene, SceneObject, Shape
from executor.render import Viewpoint
from executor.render.gl import GlRenderer
from executor.render.pieces import Pieces, matrices
from executor.render.shadow import SIZE, ShadowPlan

IDENTITY = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
SUN = np.array([0.2, 0.3, -0.9]) / np.linalg.norm([0.2, 0.3, -0.9])
VIEW = Viewpoint((0, -6, 3), (0, 0.9, -0.436), (0, 0.436, 0.9), 1.0)
CUBE = Shape("box", [0.5, 0.5, 0.5], IDENTITY, [0.7, 0.2, 0.2, 1])


def scene_of(count: int) -> Scene:
    objects = [SceneObject(i, f"o{i}", "", "dynamic", [CUBE], IDENTITY) for i in range(count)]
    return Scene("test", 0.0, objects, {}, [Light(SUN.tolist(), 1.0)], [0.8, 0.8, 0.8, 1.0], [])


def at(*places: tuple[float, float]) -> NDArray[np.float32]:
    return np.array([[x, y, 0.25, 0, 0, 0, 1] for x, y in places], np.float32)


def plan_of(poses: NDArray[np.float32]) -> ShadowPlan:
    return ShadowPlan(Pieces(scene_of(len(poses))), matrices(poses), SUN)


def test_first_everything_is_drawn_then_nothing_then_changes() -> None:
    poses = at((-3, 0), (0, 0), (3, 0))
    plan = plan_of(poses)
    placed = matrices(poses)
    assert [rectangle for rectangle, _ in plan.dirty(placed, VIEW)] == [(0, 0, SIZE, SIZE)]
    assert plan.dirty(placed, VIEW) == []
    assert plan.dirty(matrices(poses), VIEW) == []
    work = plan.dirty(matrices(at((-3, 0), (0.1, 0), (3, 0))), VIEW)
    assert len(work) == 1
    (_, _, wide, high), order = work[0]
    assert wide * high < 0.1 * SIZE * SIZE
    assert len(order) == 36


def test_a_slow_drift_adds_up() -> None:
    plan = plan_of(at((0, 0), (3, 0)))
    plan.dirty(matrices(at((0, 0), (3, 0))), VIEW)
    drawn = [plan.dirty(matrices(at((0.00004 * i, 0), (3, 0))), VIEW) for i in range(1, 6)]
    assert [bool(work) for work in drawn] == [False, False, True, False, False]


def test_a_viewer_that_leaves_the_map_moves_it() -> None:
    plan = plan_of(at((-1, 0), (1, 0)))
    plan.dirty(matrices(at((-1, 0), (1, 0))), VIEW)
    before = plan.reach_m
    work = plan.dirty(matrices(at((-1, 0), (9, 0))), VIEW)
    assert [rectangle for rectangle, _ in work] == [(0, 0, SIZE, SIZE)]
    assert plan.reach_m > before


def test_a_wide_world_has_its_map_where_one_looks() -> None:
    poses = at((-80, 0), (80, 0))
    plan = plan_of(poses)
    placed = matrices(poses)
    plan.dirty(placed, VIEW)
    here = plan.matrix.copy()
    assert plan.dirty(placed, VIEW) == []
    elsewhere = Viewpoint((60, -6, 3), VIEW.ahead, VIEW.up, 1.0)
    assert len(plan.dirty(placed, elsewhere)) == 1
    assert not np.allclose(plan.matrix, here)


def test_redrawn_parts_look_as_if_all_had_been_drawn() -> None:
    ways = [at((-1 + 0.1 * i, 0.05 * i), (1, 0.5), (0.2, 1.5)) for i in range(12)]
    moving, fresh = GlRenderer(), GlRenderer()
    moving.load(scene_of(3))
    for poses in ways:
        picture = moving.draw(poses, VIEW, 320, 240)
    fresh.load(scene_of(3))
    expected = fresh.draw(ways[0], VIEW, 320, 240)
    assert np.abs(picture.astype(int) - expected).max() > 50
    fresh.load(scene_of(3))
    expected = fresh.draw(ways[-1], VIEW, 320, 240)
    moving.close()
    fresh.close()
    # The maps may differ by a fraction of a texel, so edges of shadows may differ by a pixel.
    assert np.mean(np.abs(picture.astype(int) - expected).max(axis=2) > 30) == pytest.approx(0.0, abs=0.005)
