"""A view that is redrawn in parts equals a full redraw."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from executor.messages import Light, Scene, SceneObject, Shape
from executor.render import Viewpoint, look_at
from executor.render.gl import GlRenderer
from executor.render.picture_cache import CachedPicture
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld

SIZE = (480, 270)
VIEW = look_at((-5.0, -5.5, 4.5), (0.0, 0.0, 0.3), 1.05)
IDENTITY = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
Poses = NDArray[np.float32]
Rectangle = tuple[int, int, int, int]


@pytest.fixture(scope="module")
def renderer() -> Iterator[GlRenderer]:
    made = GlRenderer()
    yield made
    made.close()


@pytest.fixture
def parts(monkeypatch: pytest.MonkeyPatch) -> list[list[Rectangle] | None]:
    """Returns the redrawn parts of each picture; None is a full redraw."""
    seen: list[list[Rectangle] | None] = []
    ask = CachedPicture.outdated

    def told(self: CachedPicture, *arguments: object) -> list[Rectangle] | None:
        seen.append(ask(self, *arguments))  # type: ignore[arg-type]
        return seen[-1]

    monkeypatch.setattr(CachedPicture, "outdated", told)
    return seen


def moved(poses: Poses, rows: NDArray[np.intp], generator: np.random.Generator) -> Poses:
    """Moves objects at random."""
    after = poses.copy()
    after[rows, :2] += generator.uniform(-0.3, 0.3, (len(rows), 2)).astype(np.float32)
    after[rows, 2] = np.maximum(after[rows, 2] + generator.uniform(-0.1, 0.2, len(rows)), 0.05)
    turns = generator.normal(size=(len(rows), 4))
    after[rows, 3:] = turns / np.linalg.norm(turns, axis=1, keepdims=True)
    return after


@pytest.mark.parametrize("universe_id", ["walled_room", "house", "warehouse"])
def test_parts_drawn_again_are_as_if_all_had_been_drawn(
    renderer: GlRenderer, parts: list[list[Rectangle] | None], universe_id: str
) -> None:
    generator = np.random.default_rng(3)
    world = BulletWorld(load_builtin(universe_id))
    eye, target = world.universe.view.eye, world.universe.view.target
    view, poses = look_at(eye, target, 1.05), world.poses()
    renderer.load(world.scene)
    world.close()
    changed = 0
    for turn in range(14):
        if turn == 7:
            view = look_at((eye[0] * 0.6, eye[1] * 0.5, 2.5), target, 1.05)
        # Static objects of the universe move too, as when a user drags them.
        rows = generator.choice(len(poses), size=int(generator.integers(1, 4)), replace=False)
        poses = moved(poses, rows, generator)
        before = renderer.redraw(poses, view, *SIZE).copy()
        whole = renderer.draw(poses, view, *SIZE)
        assert np.abs(before.astype(int) - whole).max() <= 1
        changed += len(parts[-1] or []) if parts else 0
    assert changed > 5, "most pictures are drawn in parts"


@pytest.mark.parametrize(
    "sun", [(0.35, 0.45, -0.85), (0.8, -0.3, -0.4), (0.0, 0.0, -1.0), (0.99, 0.0, -0.05)]
)
def test_the_shadow_of_a_moving_object_moves_too(
    renderer: GlRenderer, sun: tuple[float, float, float]
) -> None:
    ball = Shape("sphere", [0.25], IDENTITY, [0.8, 0.2, 0.2, 1])
    block = Shape("box", [1.5, 1.5, 0.8], IDENTITY, [0.8, 0.8, 0.8, 1])
    objects = [SceneObject(i, f"o{i}", "", "static", [s], IDENTITY) for i, s in enumerate((ball, block))]
    scene = Scene("test", 0.0, objects, {}, [Light(list(sun), 1.0)], [0.8, 0.8, 0.8, 1.0], [])
    renderer.load(scene)
    lit = None
    for i in range(10):
        x = -1.4 + 0.3 * i
        poses = np.array([(x, -0.2, 1.3, 0, 0, 0, 1), (0.3, 0.2, 0.4, 0, 0, 0, 1)], np.float32)
        again = renderer.redraw(poses, VIEW, *SIZE).copy()
        fresh = renderer.draw(poses, VIEW, *SIZE)
        assert np.abs(again.astype(int) - fresh).max() <= 1
        if lit is not None:
            assert (np.abs(lit.astype(int) - again).max(axis=2) > 30).sum() > 200
        lit = again


def still(count: int = 2) -> tuple[Scene, Poses]:
    cube = Shape("box", [0.5, 0.5, 0.5], IDENTITY, [0.7, 0.2, 0.2, 1])
    objects = [SceneObject(i, f"o{i}", "", "static", [cube], IDENTITY) for i in range(count)]
    scene = Scene("test", 0.0, objects, {}, [Light([0.35, 0.45, -0.85], 1.0)], [0.8, 0.8, 0.8, 1.0], [])
    return scene, np.array([(i - 0.5, 0, 0.25, 0, 0, 0, 1) for i in range(count)], np.float32)


def test_where_nothing_moves_nothing_is_drawn(
    renderer: GlRenderer, parts: list[list[Rectangle] | None]
) -> None:
    scene, poses = still()
    renderer.load(scene)
    first = renderer.redraw(poses, VIEW, *SIZE)
    assert renderer.redraw(poses.copy(), VIEW, *SIZE) is first
    assert parts == [[]]
    other = poses.copy()
    other[0, 0] += 0.02
    assert renderer.redraw(other, VIEW, *SIZE) is not first
    [[part]] = parts[1:]
    assert part[2] * part[3] < 0.1 * SIZE[0] * SIZE[1]


def test_another_view_size_or_scene_is_drawn_whole(renderer: GlRenderer) -> None:
    scene, poses = still()
    renderer.load(scene)
    first = renderer.redraw(poses, VIEW, *SIZE)
    for view in (replace(VIEW, eye=(-5.0, -5.5, 4.6)), replace(VIEW, fov=1.2)):
        assert renderer.redraw(poses, view, *SIZE) is not first
        np.testing.assert_array_equal(renderer.redraw(poses, view, *SIZE), renderer.draw(poses, view, *SIZE))
    assert renderer.redraw(poses, VIEW, 320, 180).shape == (180, 320, 3)
    bright = Scene("test", 0.0, scene.objects, {}, scene.lights, [0.2, 0.8, 0.2, 1.0], [])
    renderer.load(bright)
    np.testing.assert_array_equal(renderer.redraw(poses, VIEW, *SIZE), renderer.draw(poses, VIEW, *SIZE))


def test_an_object_behind_the_eye_causes_a_full_redraw(renderer: GlRenderer) -> None:
    scene, poses = still()
    renderer.load(scene)
    near = Viewpoint((0.5, 0.0, 0.6), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), math.radians(70))
    renderer.redraw(poses, near, *SIZE)
    poses = poses.copy()
    poses[1, 2] += 0.1
    np.testing.assert_array_equal(renderer.redraw(poses, near, *SIZE), renderer.draw(poses, near, *SIZE))


def test_a_slow_drift_adds_up(renderer: GlRenderer) -> None:
    scene, poses = still()
    renderer.load(scene)
    for _ in range(60):
        poses = poses.copy()
        poses[0, 0] += 0.00005
        picture = renderer.redraw(poses, VIEW, *SIZE)
    whole = renderer.draw(poses, VIEW, *SIZE)
    assert (np.abs(picture.astype(int) - whole).max(axis=2) > 3).mean() < 1e-4
