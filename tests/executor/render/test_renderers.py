"""Both renderers draw a scene alike, and project points as the camera model requires."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from numpy.typing import NDArray

from executor.messages import Light, Scene, SceneObject, Shape
from executor.render import Renderer, RenderError, Viewpoint, look_at, make_renderer
from executor.render.gl import GlRenderer
from executor.render.tiny import TinyRenderer
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld

IDENTITY = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
SIZE = (320, 240)


@pytest.fixture(scope="module", params=["gl", "tiny"])
def renderer(request: pytest.FixtureRequest) -> Iterator[Renderer]:
    made: Renderer = GlRenderer() if request.param == "gl" else TinyRenderer()
    yield made
    made.close()


def scene_of(*shapes: Shape) -> Scene:
    objects = [SceneObject(i, f"o{i}", "", "static", [shape], IDENTITY) for i, shape in enumerate(shapes)]
    return Scene("test", 0.0, objects, {}, [Light([0.2, 0.3, -0.9], 1.0)], [0.8, 0.8, 0.8, 1.0], [])


def pose(x: float, y: float, z: float) -> NDArray[np.float32]:
    return np.array([[x, y, z, 0, 0, 0, 1]], np.float32)


def greens(picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    r, g, b = (picture[:, :, i].astype(int) for i in range(3))
    return (g > 1.6 * r) & (g > 1.6 * b) & (g > 40)


def test_known_points_are_drawn_where_the_camera_model_says(renderer: Renderer) -> None:
    renderer.load(scene_of(Shape("sphere", [0.05], IDENTITY, [0, 1, 0, 1])))
    view = Viewpoint((0, 0, 1), (1, 0, 0), (0, 0, 1), math.radians(60))
    width, height = 640, 480
    focal = width / 2 / math.tan(math.radians(30))
    for x, y, z in ((3.0, 0.0, 1.0), (3.0, 1.0, 1.5), (4.0, -1.5, 0.4), (2.0, 0.5, 1.6)):
        rows, columns = np.nonzero(greens(renderer.draw(pose(x, y, z), view, width, height)))
        assert len(rows) > 20
        assert columns.mean() == pytest.approx(width / 2 - focal * y / x - 0.5, abs=1.0)
        assert rows.mean() == pytest.approx(height / 2 - focal * (z - 1) / x - 0.5, abs=1.0)


@pytest.mark.parametrize(
    "shape",
    [
        Shape("box", [0.6, 0.8, 1.0], IDENTITY, [0, 1, 0, 1]),
        Shape("cylinder", [0.4, 1.0], IDENTITY, [0, 1, 0, 1]),
        Shape("sphere", [0.5], IDENTITY, [0, 1, 0, 1]),
        Shape("capsule", [0.3, 0.6], IDENTITY, [0, 1, 0, 1]),
        Shape("plane", [1.0, 1.0], IDENTITY, [0, 1, 0, 1]),
    ],
    ids=lambda shape: shape.shape,
)
def test_both_renderers_draw_each_shape_alike(shape: Shape) -> None:
    view = look_at((2.5, -1.5, 1.8), (0, 0, 0.6), 0.9)
    masks = []
    for made in (GlRenderer(), TinyRenderer()):
        made.load(scene_of(shape))
        masks.append(greens(made.draw(pose(0, 0, 0.6), view, *SIZE)))
        made.close()
    both, either = (masks[0] & masks[1]).sum(), (masks[0] | masks[1]).sum()
    assert either > 1000
    assert both / either > 0.95


def test_both_renderers_show_the_same_world() -> None:
    world = BulletWorld(load_builtin("person_in_green"))
    world.step(240)
    robot = world.robots[0]
    camera = robot.config.cameras[0]
    view = Viewpoint.of_pose(robot.camera_pose(camera), camera.fov, camera.near, camera.far)
    pictures = []
    for made in (GlRenderer(), TinyRenderer()):
        made.load(world.scene)
        pictures.append(made.draw(world.poses(), view, *SIZE))
        made.close()
    world.close()
    masks = [greens(picture) for picture in pictures]
    assert masks[0].sum() > 2000
    assert (masks[0] & masks[1]).sum() / (masks[0] | masks[1]).sum() > 0.93
    assert pictures[0].shape == pictures[1].shape == (SIZE[1], SIZE[0], 3)


def test_things_move_with_their_poses(renderer: Renderer) -> None:
    renderer.load(scene_of(Shape("box", [0.3, 0.3, 0.3], IDENTITY, [0, 1, 0, 1])))
    view = Viewpoint((0, 0, 0.5), (1, 0, 0), (0, 0, 1), 1.0)
    left = np.nonzero(greens(renderer.draw(pose(3, 0.5, 0.5), view, *SIZE)))[1].mean()
    right = np.nonzero(greens(renderer.draw(pose(3, -0.5, 0.5), view, *SIZE)))[1].mean()
    assert left < SIZE[0] / 2 < right


def test_a_scene_takes_the_place_of_another(renderer: Renderer) -> None:
    view = Viewpoint((0, 0, 0.5), (1, 0, 0), (0, 0, 1), 1.0)
    renderer.load(scene_of(Shape("box", [1, 1, 1], IDENTITY, [0, 1, 0, 1])))
    assert greens(renderer.draw(pose(3, 0, 0.5), view, *SIZE)).any()
    renderer.load(scene_of(Shape("box", [1, 1, 1], IDENTITY, [1, 0, 0, 1])))
    assert not greens(renderer.draw(pose(3, 0, 0.5), view, *SIZE)).any()


def test_light_makes_shadows() -> None:
    renderer = GlRenderer()
    renderer.load(scene_of(Shape("box", [1, 1, 1], IDENTITY, [0, 1, 0, 1])))
    view = look_at((4, 4, 4), (0, 0, 0), 0.8)
    lit = renderer.draw(pose(0, 0, 50), view, *SIZE).astype(int)
    shadowed = renderer.draw(pose(0, 0, 0.5), view, *SIZE).astype(int)
    renderer.close()
    darker = (lit.sum(axis=2) - shadowed.sum(axis=2) > 60) & ~greens(shadowed.astype(np.uint8))
    assert darker.sum() > 200


def test_without_egl_the_other_renderer_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(**_: object) -> None:
        raise OSError("no libEGL.so")

    monkeypatch.setattr("moderngl.create_context", fail)
    with pytest.raises(RenderError, match="libEGL"):
        make_renderer("gl")
    fallback = make_renderer()
    assert fallback.name == "TinyRenderer"
    fallback.close()


def test_the_environment_can_choose(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BT_STUDIO_RENDERER", "tiny")
    chosen = make_renderer()
    assert chosen.name == "TinyRenderer"
    chosen.close()


def test_looking_straight_down_has_a_horizon() -> None:
    view = look_at((0, 0, 5), (0, 0, 0))
    assert view.ahead == pytest.approx((0, 0, -1))
    assert np.linalg.norm(view.up) == pytest.approx(1)
