import pytest

from executor.ram.translate import WORLD_ALIASES
from executor.universes import BUILTIN_IDS, UniverseError, load_builtin, parse_universe
from executor.world.physics.bullet import BulletWorld

HEAD = "format: bt-studio/universe\nversion: 1\nname: test\n"


@pytest.mark.parametrize("universe_id", BUILTIN_IDS)
def test_every_builtin_loads_and_its_robots_stand_free(universe_id: str) -> None:
    world = BulletWorld(load_builtin(universe_id), seed=1)
    world.step(60)
    assert [robot.collisions for robot in world.robots] == [0] * len(world.robots)
    world.close()


@pytest.mark.parametrize("universe_id", BUILTIN_IDS)
def test_the_largest_robot_finds_room_too(universe_id: str) -> None:
    world = BulletWorld(load_builtin(universe_id), seed=2, robot="rover")
    world.step(60)
    assert world.robots[0].collisions == 0
    assert load_builtin(universe_id).description
    world.close()


def test_the_scene_of_the_benchmarks_is_full() -> None:
    assert len(load_builtin("warehouse").models) >= 200


def test_obstacles_stand_elsewhere_for_each_seed() -> None:
    places = []
    for seed in (1, 2, 1):
        world = BulletWorld(load_builtin("random_obstacles"), seed=seed)
        places.append(world.poses()[:, :2].tobytes())
        world.close()
    assert places[0] == places[2] != places[1]


def test_an_unknown_builtin_suggests_the_near_one() -> None:
    with pytest.raises(UniverseError, match="did you mean 'walled_room'"):
        load_builtin("walled_rom")
    with pytest.raises(UniverseError, match=r"there are: .*empty"):
        load_builtin("xyz")


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("models:\n  - {id: a, shape: box, size: [1, 1], pose: [0, 0, 0, 0, 0, 0]}\n", 5, "size.*x, y, z"),
        ("models:\n  - {id: a, shape: sphere, size: [1], colour: red}\n", 5, "did you mean 'color'"),
        ("models:\n  - {id: a, shape: torus, size: [1]}\n", 5, "shape"),
        ("models:\n  - {id: a, shape: sphere, size: [-1]}\n", 5, "greater than 0"),
        ("models:\n  - {id: a, shape: sphere, size: [.nan]}\n", 5, "finite"),
        ("models:\n  - {id: a, shape: sphere, size: [1], pose: [0, 0]}\n", 5, "pose"),
        (
            "models:\n  - {id: a, shape: sphere, size: [1]}\n  - {id: a, shape: sphere, size: [1]}\n",
            1,
            "twice",
        ),
        ("actors:\n  - {id: a, path: []}\n", 5, "path"),
        ("random: {ghost.pose.x: [0, 1]}\n", 1, "ghost"),
        ("lights: [{direction: [0, 0, 0]}]\n", 4, "direction"),
        ("grund: {}\n", 4, "did you mean 'ground'"),
        ("robots:\n  - {id: r, topics: {camera: no spaces}}\n", 5, "topics"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(text: str, line: int, message: str) -> None:
    with pytest.raises(UniverseError, match=message) as caught:
        parse_universe(HEAD + text)
    assert caught.value.problems[0].line == line


def test_all_problems_are_said_at_once() -> None:
    with pytest.raises(UniverseError) as caught:
        parse_universe("format: bt-studio/universe\nversion: 2\nmodels: [{id: 1}]\n")
    assert [problem.line for problem in caught.value.problems] == [1, 2, 3, 3]
    assert "universe.yaml:1:1: BTU003 name is missing" in str(caught.value)


def test_people_wait_for_robots_in_the_worlds_that_stand_for_those_of_jderobot() -> None:
    for universe_id in set(WORLD_ALIASES.values()):
        assert all(actor.yields for actor in load_builtin(universe_id).actors), universe_id
