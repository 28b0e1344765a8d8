"""No two faces of different looks overlap in one plane: they would flicker, here and in the browser."""

import pytest

from executor.robots import robot_ids
from executor.universes import BUILTIN_IDS, load_builtin, parse_universe
from executor.world.physics.bullet import BulletWorld
from tests.executor.universes.coplanar import overlapping

HEAD = "format: bt-studio/universe\nversion: 1\nname: test\n"
FIRST = "  - {id: a, shape: box, size: [1, 1, 1], pose: [0, 0, 0.5, 0, 0, 0], color: '#ff0000'}\n"


def found_in(world: BulletWorld) -> list[str]:
    found = overlapping(world.scene, world.poses())
    world.close()
    return found


@pytest.mark.parametrize("universe_id", BUILTIN_IDS)
def test_no_faces_of_a_universe_fight(universe_id: str) -> None:
    assert found_in(BulletWorld(load_builtin(universe_id), seed=1)) == []


@pytest.mark.parametrize("robot_id", robot_ids())
def test_no_faces_of_a_robot_fight(robot_id: str) -> None:
    assert found_in(BulletWorld(parse_universe(f"{HEAD}robots: [{{model: {robot_id}}}]\n"))) == []


@pytest.mark.parametrize(
    ("second", "fights"),
    [
        ("size: [1, 1, 1], pose: [0.5, 0, 0.5, 0, 0, 0]", True),  # the same height: the tops, and both sides
        ("size: [1, 0.9, 0.99], pose: [0.5, 0, 0.495, 0, 0, 0]", False),
        ("size: [0.5, 0.5, 1], pose: [5, 0, 0.5, 0, 0, 0]", False),  # elsewhere
        ("size: [1, 1, 1], pose: [1, 0, 0.5, 0, 0, 0]", False),  # side by side
        ("size: [0.5, 0.5, 0.001], pose: [3, 0, 0.0005, 0, 0, 0]", True),  # one with the ground
        ("size: [0.5, 0.5, 1], pose: [0.2, 0, 1.5, 0, 0, 0]", False),  # stands on it
    ],
)
def test_the_search_finds_what_fights_and_nothing_else(second: str, *, fights: bool) -> None:
    models = f"models:\n{FIRST}  - {{id: b, shape: box, {second}, color: '#00ff00'}}\nrobots: []\n"
    assert bool(found_in(BulletWorld(parse_universe(HEAD + models)))) is fights


def test_what_is_hidden_in_a_third_thing_does_not_fight() -> None:
    second = "  - {id: b, shape: box, size: [1, 1, 1], pose: [0.5, 0, 0.5, 0, 0, 0], color: '#00ff00'}\n"
    cover = "  - {id: c, shape: box, size: [3, 3, 3], pose: [0, 0, 1.5, 0, 0, 0], color: '#0000ff'}\n"
    models = f"models:\n{FIRST}{second}{cover}robots: []\n"
    assert found_in(BulletWorld(parse_universe(HEAD + models))) == []
