from executor.universes import parse_universe
from executor.world.physics.randomize import draw

TEXT = """
format: bt-studio/universe
version: 1
name: test
models: [{id: crate, shape: box, size: [1, 1, 1], pose: [0, 2, 0.5, 0, 0, 0]}]
actors: [{id: walker, path: [[0, 0]]}]
random: {crate.pose.x: [1, 3], crate.mass: [1, 2], walker.speed: [0.3, 0.6]}
"""


def test_values_are_drawn_within_their_ranges() -> None:
    universe = parse_universe(TEXT)
    for seed in range(20):
        drawn = draw(universe, seed)
        assert 1 <= drawn.models[0].pose[0] <= 3
        assert drawn.models[0].pose[1:] == universe.models[0].pose[1:]
        assert 1 <= drawn.models[0].mass <= 2
        assert 0.3 <= drawn.actors[0].speed <= 0.6


def test_the_seed_decides() -> None:
    universe = parse_universe(TEXT)
    assert draw(universe, 3) == draw(universe, 3)
    assert draw(universe, 3) != draw(universe, 4)


def test_without_ranges_nothing_changes() -> None:
    universe = parse_universe(TEXT.replace("random:", "#"))
    assert draw(universe, 5) is universe
