"""Depth in m and the object of each pixel, equal from both renderers."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from numpy.typing import NDArray

from executor.messages import Light, Scene, SceneObject, Shape
from executor.render import GROUND, NOTHING, Renderer, Viewpoint
from executor.render.gl import GlRenderer
from executor.render.tiny import TinyRenderer
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld

IDENTITY = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
SIZE = (320, 240)
AHEAD = Viewpoint((0, 0, 1), (1, 0, 0), (0, 0, 1), math.radians(60))


@pytest.fixture(scope="module", params=["gl", "tiny"])
def renderer(request: pytest.FixtureRequest) -> Iterator[Renderer]:
    made: Renderer = GlRenderer() if request.param == "gl" else TinyRenderer()
    yield made
    made.close()


def scene_of(*shapes: Shape) -> Scene:
    objects = [SceneObject(i, f"o{i}", "", "static", [shape], IDENTITY) for i, shape in enumerate(shapes)]
    return Scene("test", 0.0, objects, {}, [Light([0.2, 0.3, -0.9], 1.0)], [0.8, 0.8, 0.8, 1.0], [])


def poses(*places: tuple[float, float, float]) -> NDArray[np.float32]:
    return np.array([[*place, 0, 0, 0, 1] for place in places], np.float32)


def test_depth_is_measured_along_the_axis(renderer: Renderer) -> None:
    renderer.load(scene_of(Shape("box", [1.0, 2.0, 1.0], IDENTITY, [1, 0, 0, 1])))
    depth = renderer.depth(poses((4.5, 0, 1)), AHEAD, *SIZE)
    assert depth.shape == (240, 320)
    assert depth.dtype == np.float32
    assert depth[120, 160] == pytest.approx(4.0, abs=0.01)
    # The face is flat: its depth does not grow towards the sides, unlike the distance along the rays.
    assert depth[120, 105] == pytest.approx(4.0, abs=0.01)
    assert np.isposinf(depth[0]).all()


def test_ground_has_the_depth_of_its_rows(renderer: Renderer) -> None:
    renderer.load(scene_of())
    depth = renderer.depth(np.empty((0, 7), np.float32), AHEAD, *SIZE)
    focal = SIZE[0] / 2 / math.tan(math.radians(30))
    for row in (160, 200, 230):
        assert depth[row, 10] == pytest.approx(focal / (row + 0.5 - SIZE[1] / 2), rel=0.03)


def test_each_pixel_knows_its_object(renderer: Renderer) -> None:
    shape = Shape("box", [0.6, 0.6, 0.6], IDENTITY, [1, 0, 0, 1])
    renderer.load(scene_of(shape, shape, Shape("sphere", [0.3], IDENTITY, [0, 1, 0, 1])))
    rows = renderer.segmentation(poses((3, 1, 1), (3, -1, 1), (3, 0, 1)), AHEAD, *SIZE)
    assert rows.dtype == np.int32
    focal = SIZE[0] / 2 / math.tan(math.radians(30))
    beside = round(focal / 3)
    assert [rows[120, 160 - beside], rows[120, 160 + beside], rows[120, 160]] == [0, 1, 2]
    assert (rows[0, 0], rows[-1, 0]) == (NOTHING, GROUND)


def test_both_renderers_measure_the_same_world() -> None:
    world = BulletWorld(load_builtin("person_in_green"))
    world.step(240)
    robot = world.robots[0]
    camera = robot.config.cameras[0]
    view = Viewpoint.of_pose(robot.camera_pose(camera), camera.fov, camera.near, camera.far)
    measured = []
    for made in (GlRenderer(), TinyRenderer()):
        made.load(world.scene)
        measured.append(
            (made.depth(world.poses(), view, *SIZE), made.segmentation(world.poses(), view, *SIZE))
        )
        made.close()
    world.close()
    (gl_depth, gl_rows), (tiny_depth, tiny_rows) = measured
    same = gl_rows == tiny_rows
    assert same.mean() > 0.97
    seen = same & np.isfinite(gl_depth) & (gl_depth < 8)
    apart = np.abs(gl_depth[seen] - tiny_depth[seen]) / gl_depth[seen]
    assert seen.mean() > 0.3
    assert np.quantile(apart, 0.95) < 0.05
