"""The map of a scene: what a robot would bump into, and nothing else."""

from __future__ import annotations

import math

import numpy as np
import pytest

from executor.navigation.mapping import map_of
from executor.navigation.planner import Map, Search
from executor.stream_messages import Mesh, Scene, SceneObject, Shape
from executor.world.simulation.launch import make_world

STILL = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
WHITE = [1.0, 1.0, 1.0, 1.0]


def scene_of(*shapes: Shape, kind: str = "static", meshes: dict[str, Mesh] | None = None) -> Scene:
    things = [SceneObject(0, "thing", "", kind, list(shapes), STILL)]  # type: ignore[arg-type]
    return Scene("test", 0.0, things, meshes or {}, [], [0, 0, 0], [])


def is_occupied(scene: Scene, x: float, y: float) -> bool:
    grid = map_of(scene)
    cell = grid.cell(x, y)
    assert cell is not None
    return bool(grid.occupied[cell])


def test_a_turned_box_is_occupied_within_its_outline() -> None:
    pose = [1.0, 0.0, 0.5, 0.0, 0.0, math.sin(math.pi / 8), math.cos(math.pi / 8)]
    scene = scene_of(Shape("box", [2.0, 0.2, 1.0], pose, WHITE))
    assert is_occupied(scene, 1.6, 0.6)
    assert not is_occupied(scene, 1.6, -0.6)


@pytest.mark.parametrize(
    ("shape", "size", "inside", "outside"),
    [
        ("cylinder", [0.5, 1.0], 0.45, 0.6),
        ("sphere", [0.5], 0.45, 0.6),
        ("capsule", [0.3, 1.0], 0.25, 0.4),
    ],
)
def test_round_things_are_round(shape: str, size: list[float], inside: float, outside: float) -> None:
    scene = scene_of(Shape(shape, size, STILL, WHITE))  # type: ignore[arg-type]
    assert is_occupied(scene, inside, 0.0)
    assert is_occupied(scene, inside * 0.7, inside * 0.7)
    assert not is_occupied(scene, outside, 0.0)
    assert not is_occupied(scene, outside * 0.8, outside * 0.8)


@pytest.mark.parametrize("z", [-0.5, 2.0])
def test_what_is_below_or_above_the_robot_is_free(z: float) -> None:
    scene = scene_of(Shape("box", [1.0, 1.0, 0.5], [0, 0, z, 0, 0, 0, 1], WHITE))
    assert not is_occupied(scene, 0.0, 0.0)


def test_robots_ceilings_and_floors_are_free() -> None:
    box = Shape("box", [1.0, 1.0, 1.0], STILL, WHITE)
    assert not is_occupied(scene_of(box, kind="robot"), 0.0, 0.0)
    assert not is_occupied(scene_of(Shape("plane", [4.0, 4.0], STILL, WHITE)), 0.0, 0.0)
    assert not is_occupied(scene_of(Shape("box", [1, 1, 1], STILL, WHITE, ceiling=True)), 0.0, 0.0)


def test_a_mesh_is_occupied_where_its_triangles_are() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.2]], np.float32)
    mesh = Mesh(corners.tobytes(), corners.tobytes(), np.array([0, 1, 2], np.uint32).tobytes())
    scene = scene_of(Shape("mesh", [1, 1, 1], STILL, WHITE, mesh="m"), meshes={"m": mesh})
    assert is_occupied(scene, 0.3, 0.3)
    assert not is_occupied(scene, 0.8, 0.8)


@pytest.mark.simulation
def test_every_room_of_the_house_is_reached_through_its_doors() -> None:
    world = make_world("house")
    try:
        space = Map(map_of(world.scene), 0.2)
    finally:
        world.close()
    start = space.grid.cell(0.0, 1.2)
    assert start is not None
    for x, y in ((-2.0, -2.0), (3.0, -2.5), (-3.0, 3.0), (0.0, 3.0), (4.0, 2.6)):
        near = space.grid.cell(x, y)
        assert near is not None
        goal = space.nearest_free(near, 1.0)
        begin = space.nearest_free(start, 0.5)
        assert goal is not None
        assert begin is not None
        search = Search(space, begin, goal)
        assert search.expand(200_000)
        assert search.path is not None, (x, y)
