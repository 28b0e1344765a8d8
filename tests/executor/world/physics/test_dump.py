"""The state of a world as plain data: a fresh process continues exactly as the first would have."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import msgspec
import pytest

from executor.robots import robot_ids
from executor.universes import BUILTIN_IDS as UNIVERSES
from executor.world.interface import WorldError
from executor.world.physics.dump import DUMP_VERSION
from executor.world.simulation.launch import make_world
from tests.budget import count
from tests.executor.world.physics.continue_world import drive

ROOT = Path(__file__).parents[4]
ROBOTS = sorted(robot_ids())
PAIRS = [
    (universe, ROBOTS[(i + turn) % len(ROBOTS)])
    for i, universe in enumerate(sorted(UNIVERSES))
    for turn in range(min(count("world_dump_robots"), len(ROBOTS)))
]
SECONDS_EACH = 15.0
KNOWN_TO_DIFFER = {"crowd.lookout"}
"""A person touches several of the five collision shapes of its base: see `executor.world.physics.dump`."""


@pytest.mark.simulation
@pytest.mark.timeout(SECONDS_EACH * len(PAIRS) * 2)
def test_a_fresh_process_continues_every_world_bit_for_bit(tmp_path):
    expected = {}
    for universe, robot in PAIRS:
        world = make_world(universe, seed=3, robot=robot)
        drive(world)
        (tmp_path / f"{universe}.{robot}").write_bytes(world.dump())
        expected[f"{universe}.{robot}"] = drive(world)
        world.close()
    command = [sys.executable, "-m", "tests.executor.world.physics.continue_world", str(tmp_path)]
    subprocess.run(command, cwd=ROOT, check=True, timeout=SECONDS_EACH * len(PAIRS))
    found = {path.stem: path.read_bytes() for path in tmp_path.glob("*.after")}
    assert found.keys() == expected.keys()
    assert {name for name in expected if found[name] != expected[name]} <= KNOWN_TO_DIFFER


@pytest.mark.simulation
def test_bodies_that_a_user_moved_are_where_they_were():
    first, second = make_world("walled_room"), make_world("walled_room")
    body = first.universe.models[0].id
    where = [1.0, 1.0, 0.5, 0.0, 0.0, 0.5]
    first.move_body(body, where)
    untouched = second.dump()
    second.load(first.dump())
    assert second.poses().tobytes() == first.poses().tobytes()
    second.load(untouched)
    assert second.poses().tobytes() == make_world("walled_room").poses().tobytes()


@pytest.mark.simulation
def test_a_state_of_another_world_is_refused():
    world, other = make_world("empty"), make_world("walled_room")
    with pytest.raises(WorldError, match="the state is of the world"):
        world.load(other.dump())
    with pytest.raises(WorldError, match="cannot be read"):
        world.load(b"\xc1")
    newer = msgspec.msgpack.decode(world.dump()) | {"version": DUMP_VERSION + 1}
    with pytest.raises(WorldError, match="this program reads up to"):
        world.load(msgspec.msgpack.encode(newer))
    broken = msgspec.msgpack.decode(world.dump()) | {"physics": b""}
    with pytest.raises(WorldError, match="does not fit"):
        world.load(msgspec.msgpack.encode(broken))
