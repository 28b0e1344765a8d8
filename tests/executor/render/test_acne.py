"""A lit flat face without anything above it has one shade: the shadow map does not shade its own surfaces."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from executor.messages import Light, Scene, SceneObject, Shape
from executor.render import Viewpoint, look_at
from executor.render.gl import GlRenderer
from executor.render.pieces import matrices

IDENTITY = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
WALL = [0.1, 3.0, 1.2]
SUNS = [(0.35, 0.45, -0.85), (0.9, 0.1, -0.4), (0.99, 0.0, -0.12)]
SIZE = (480, 360)


def scene_of(sun: tuple[float, float, float], wide_m: float) -> Scene:
    """Returns a wall, and two small objects so far apart that the shadow map covers that range."""
    post = Shape("box", [0.02, 0.02, 0.02], IDENTITY, [0.5, 0.5, 0.5, 1])
    wall = Shape("box", WALL, IDENTITY, [0.8, 0.5, 0.3, 1])
    objects = [
        SceneObject(0, "wall", "", "static", [wall], IDENTITY),
        SceneObject(1, "west", "", "static", [post], IDENTITY),
        SceneObject(2, "east", "", "static", [post], IDENTITY),
    ]
    return Scene("test", 0.0, objects, {}, [Light(list(sun), 1.0)], [0.8, 0.8, 0.8, 1.0], [])


def poses_of(wide_m: float, yaw: float) -> NDArray[np.float32]:
    turn = (0, 0, math.sin(yaw / 2), math.cos(yaw / 2))
    half = wide_m / 2
    return np.array(
        [(0, 0, 0.6, *turn), (-half, -half, 0.01, 0, 0, 0, 1), (half, half, 0.01, 0, 0, 0, 1)], np.float32
    )


@pytest.fixture(scope="module")
def renderer() -> GlRenderer:
    return GlRenderer()


def shades(renderer: GlRenderer, scene: Scene, poses: NDArray[np.float32], view: Viewpoint) -> list[float]:
    """Returns the spread of the brightness of the pixels of each lit face of the wall."""
    picture = renderer.draw(poses, view, *SIZE, smooth=False).astype(int)
    rows, metres = renderer.segmentation(poses, view, *SIZE), renderer.depth(poses, view, *SIZE)
    place = matrices(poses)[0].astype(float)
    local = (seen_points(view, metres) - place[:, 3]) @ place[:, :3]
    found = []
    for axis, half in enumerate(np.array(WALL) / 2):
        for side in (-1.0, 1.0):
            normal = place[:, axis] * side
            others = [i for i in range(3) if i != axis]
            inner = np.abs(local[:, :, others]) < np.array(WALL)[others] / 2 - 0.015
            on_face = (rows == 0) & (np.abs(local[:, :, axis] * side - half) < 0.01) & inner.all(axis=2)
            if on_face.sum() > 100 and -normal @ np.array(scene.lights[0].direction) > 0.02:
                found.append(float(np.ptp(picture[on_face].sum(axis=1)) / 3))
    return found


def seen_points(view: Viewpoint, metres: NDArray[np.float32]) -> NDArray[np.float64]:
    width, height = SIZE
    right = np.cross(view.ahead, view.up)
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    focal = width / 2 / math.tan(view.fov / 2)
    across, down = (x - width / 2) / focal, (y - height / 2) / focal
    rays = np.array(view.ahead) + across[..., None] * right - down[..., None] * np.array(view.up)
    return np.asarray(np.array(view.eye) + rays * np.where(np.isfinite(metres), metres, 0.0)[..., None])


@pytest.mark.parametrize("wide_m", [14.0, 40.0])
@pytest.mark.parametrize("sun", SUNS)
def test_a_wall_does_not_shade_itself(
    renderer: GlRenderer, sun: tuple[float, float, float], wide_m: float
) -> None:
    scene = scene_of(sun, wide_m)
    renderer.load(scene)
    apart = []
    for yaw in np.linspace(0.0, math.pi, 5):
        poses = poses_of(wide_m, float(yaw))
        for eye in ((2.6, 1.2, 1.9), (-2.6, 1.2, 1.9), (-2.2, -1.8, 0.7), (2.2, -1.8, 0.7)):
            apart += shades(renderer, scene, poses, look_at(eye, (0, 0, 0.6), 1.0))
    assert len(apart) > 12
    assert max(apart) <= 3.0


def test_the_wall_throws_its_shadow_from_its_foot_on(renderer: GlRenderer) -> None:
    """There is no gap between an object and its shadow, which would make it seem to float."""
    renderer.load(scene_of(SUNS[0], 14.0))
    poses = poses_of(14.0, 0.0)
    view = look_at((3.0, 0.0, 2.0), (0.05, 0.0, 0.0), 0.6)
    picture = renderer.draw(poses, view, *SIZE, smooth=False).astype(int).sum(axis=2)
    column = picture[:, SIZE[0] // 2]
    ground = renderer.segmentation(poses, view, *SIZE)[:, SIZE[0] // 2] == -2
    metres = seen_points(view, renderer.depth(poses, view, *SIZE))[:, SIZE[0] // 2]
    near = ground & (metres[:, 0] > 0.055) & (metres[:, 0] < 0.4)
    lit = ground & (metres[:, 0] > 0.7)
    assert near.sum() > 10
    assert column[near].max() < column[lit].min() - 60
