"""Distances in a world, against numbers by hand."""

import pytest

from executor.evaluation.clearance import Clearance, Placement, bodies_to
from executor.universes import parse_universe
from executor.world.physics.bullet import BulletWorld
from tests.executor.evaluation.projects import WORLD

pytestmark = pytest.mark.simulation


@pytest.fixture
def world():
    made = BulletWorld(parse_universe(WORLD))
    yield made
    made.close()


def test_the_smallest_distance_is_kept_and_only_gets_smaller(world):
    robot = world.robots[0]
    near = Clearance(world.bullet, robot, bodies_to(world, "wall"))
    near.look()
    front = 2.9 - near.smallest_m
    assert 0.15 < front < 0.2  # half the robot's length
    world.move_body("rob", (1, 0, 0, 0, 0, 0))
    near.look()
    closer = near.smallest_m
    assert closer == pytest.approx(1.9 - front, abs=1e-3)
    world.move_body("rob", (-1, -1, 0, 0, 0, 0))
    near.look()
    assert near.smallest_m == closer
    world.move_body("rob", (2.8, 0, 0, 0, 0, 0))
    near.look()
    assert near.smallest_m == 0


def test_words_name_bodies(world):
    solids = world.solids()
    assert set(solids) == {"wall", "crate", "walker", "rob"}
    assert set(bodies_to(world, "models")) == {*solids["wall"], *solids["crate"]}
    assert bodies_to(world, "actors") == list(solids["walker"])
    assert bodies_to(world, "crate") == list(solids["crate"])
    with pytest.raises(KeyError):
        bodies_to(world, "carpet")


def test_nothing_near_has_no_distance(world):
    far = Clearance(world.bullet, world.robots[0], bodies_to(world, "walker"))
    world.move_body("rob", (-3, 9, 0, 0, 0, 0))
    far.look()
    assert far.smallest_m is None


def test_a_box_with_two_centimetres_round_it_decides_about_overlaps(world):
    placement = Placement(world)
    half = 0.2
    for gap, touches in ((0.015, True), (0.03, False), (-0.1, True)):
        placement.move("crate", (2.9 - half - gap, 0, 0.2, 0, 0, 0))
        assert placement.overlaps("crate", frozenset()) is touches, gap
    placement.move("crate", (0.1, 0, 0.2, 0, 0, 0))
    assert placement.overlaps("rob", frozenset())
    assert not placement.overlaps("rob", frozenset({"crate"}))
    turned = (2.9 - half - 0.03, 0, 0.2, 0, 0, 0.7854)  # its corner is in the wall now
    placement.move("crate", turned)
    assert placement.overlaps("crate", frozenset())
    assert not placement.overlaps("carpet", frozenset())
