"""Indoors a robot's camera sees a ceiling; views from above see the rooms, and rays are unchanged."""

import math
from collections.abc import Iterator

import numpy as np
import pytest

from executor.render import Renderer, Viewpoint, look_at
from executor.render.gl import GlRenderer
from executor.render.tiny import TinyRenderer
from executor.universes import UniverseError, load_builtin, parse_universe
from executor.world.physics.bullet import BulletWorld
from executor.world.physics.ceiling import ceiling_of

HEAD = "format: bt-studio/universe\nversion: 1\nname: test\n"
CEILING = 'ceiling: {height: 2.4, color: "#ffffff"}\n'
WALLS = """\
models:
  - {id: east, shape: box, size: [0.2, 6, 1.2], pose: [3.1, 0, 0.6, 0, 0, 0], to_ceiling: true}
  - {id: west, shape: box, size: [0.2, 6, 1.2], pose: [-3.1, 0, 0.6, 0, 0, 0], to_ceiling: true}
  - {id: north, shape: box, size: [6, 0.2, 1.2], pose: [0, 3.1, 0.6, 0, 0, 0], to_ceiling: true}
  - {id: tree, shape: box, size: [0.2, 0.2, 1.2], pose: [20, 0, 0.6, 0, 0, 0]}
robots: []
"""
SIZE = (320, 240)


@pytest.fixture(params=[GlRenderer, TinyRenderer])
def renderer(request: pytest.FixtureRequest) -> Iterator[Renderer]:
    made = request.param()
    yield made
    made.close()


def world_of(*parts: str) -> BulletWorld:
    return BulletWorld(parse_universe(HEAD + "".join(parts)))


def row_of(world: BulletWorld, body: str) -> int:
    return next(o.id for o in world.scene.objects if o.body == body)


def test_the_camera_sees_it_and_the_view_does_not(renderer: Renderer) -> None:
    world = world_of(CEILING, WALLS)
    renderer.load(world.scene)
    ceiling, east = row_of(world, "ceiling"), row_of(world, "east")
    camera = Viewpoint((0.0, 0.0, 0.4), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), math.radians(100))
    column = renderer.segmentation(world.poses(), camera, *SIZE)[:, SIZE[0] // 2]
    metres = renderer.depth(world.poses(), camera, *SIZE)[:, SIZE[0] // 2]
    focal = SIZE[0] / 2 / math.tan(camera.fov / 2)
    up = (SIZE[1] / 2 - np.arange(SIZE[1]) - 0.5) / focal
    # The wall ends where the ceiling begins, 2 m above the eye and 3 m ahead.
    assert (column[up > 2.06 / 3] == ceiling).all()
    assert (column[(up < 1.97 / 3) & (up > -0.1)] == east).all()
    assert metres[0] == pytest.approx(2.0 / up[0], abs=0.02)
    for view in (
        look_at((0.5, 0, 9), (0, 0, 0)),
        look_at((-6, -5, 4), (0, 0, 0)),
        look_at((0, 0, 1), (3, 0, 2)),
    ):
        assert not (renderer.segmentation(world.poses(), view, *SIZE) == ceiling).any()
    world.close()


def test_views_of_the_world_are_the_same_with_and_without(renderer: Renderer) -> None:
    pictures = []
    for parts in ((CEILING, WALLS), (WALLS,)):
        world = world_of(*parts)
        renderer.load(world.scene)
        pictures.append(renderer.draw(world.poses(), look_at((-6, -5, 4), (0, 0, 0)), *SIZE).astype(int))
        world.close()
    # The shadow maps may differ slightly.
    assert np.mean(np.abs(pictures[0] - pictures[1]).max(axis=2) > 30) < 0.002


def test_it_covers_the_walls_that_reach_it() -> None:
    world = world_of(CEILING, WALLS)
    overhead = world.scene.objects[row_of(world, "ceiling")]
    [shape] = overhead.shapes
    world.close()
    assert shape.size == pytest.approx([6.4, 6.2])
    assert overhead.pose[:3] == pytest.approx([0.0, 0.1, 2.4])


@pytest.mark.parametrize("universe_id", ["house", "office_corridor", "warehouse"])
def test_rays_hit_the_same_as_before(universe_id: str) -> None:
    universe = load_builtin(universe_id)
    ranges = []
    for each in (universe, universe.model_copy(update={"ceiling": None})):
        world = BulletWorld(each, seed=3)
        world.step(60)
        ranges.append(world.robots[0].scan(world.robots[0].config.lidars[0]).ranges)
        names = [o.body for o in world.scene.objects]
        world.close()
    np.testing.assert_array_equal(ranges[0], ranges[1])
    assert "ceiling" not in names
    assert universe.ceiling is not None


def test_a_wall_that_is_carried_takes_its_upper_part_along() -> None:
    world = world_of(CEILING, WALLS)
    row = row_of(world, "east")
    lower, upper = world.scene.objects[row].shapes
    world.close()
    assert not lower.ceiling
    assert upper.ceiling
    top = 0.6 + upper.pose[2] + upper.size[2] / 2
    assert (top, upper.size[:2]) == (pytest.approx(2.4), [0.2, 6.0])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("ceiling: {height: 0}\n", "greater than 0"),
        ("ceiling: {hight: 2}\n", "did you mean 'height'"),
        ("models: [{id: a, shape: sphere, size: [1], to_ceiling: true}]\n", "only a box"),
        ("models: [{id: a, shape: box, size: [1, 1, 1], mass: 2, to_ceiling: true}]\n", "only a box"),
        (
            "ceiling: {}\nmodels: [{id: ceiling, shape: box, size: [1, 1, 1]}]\n",
            "the id 'ceiling' is taken",
        ),
    ],
)
def test_errors_are_reported(text: str, message: str) -> None:
    with pytest.raises(UniverseError, match=message):
        parse_universe(HEAD + text)


def test_without_anything_that_stands_there_is_none() -> None:
    world = world_of(CEILING)
    assert all(o.body != "ceiling" for o in world.scene.objects)
    world.close()


def test_a_universe_without_a_ceiling_has_none() -> None:
    plain = parse_universe("format: bt-studio/universe\nversion: 1\nname: x\n")
    assert ceiling_of(plain) is None
