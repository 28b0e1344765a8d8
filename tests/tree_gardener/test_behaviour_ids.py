"""The ids of behaviours: as those of `uuid.uuid4`, and other ones in each process."""

from __future__ import annotations

import os
import random
import uuid

import py_trees

from tree_gardener.behaviour_ids import Ids, install, random_id


def test_an_id_is_a_random_uuid_of_version_4() -> None:
    ids = [random_id() for _ in range(1_000)]
    assert len(set(ids)) == len(ids)
    assert {(each.version, each.variant, each.is_safe) for each in ids} == {
        (4, uuid.RFC_4122, uuid.SafeUUID.unknown)
    }
    assert all(uuid.UUID(str(each)) == each for each in ids)
    for bit in range(128):  # all others are random
        is_fixed = bit in (62, 63) or 76 <= bit < 80
        assert len({each.int >> bit & 1 for each in ids}) == (1 if is_fixed else 2)


def test_behaviours_take_their_ids_from_there_and_leave_the_seed_alone() -> None:
    install()
    assert vars(py_trees.behaviour)["uuid"] is Ids
    random.seed(7)
    expected = random.getrandbits(64)
    random.seed(7)
    made = py_trees.behaviours.Success("s")
    assert isinstance(made.id, uuid.UUID)
    assert random.getrandbits(64) == expected


def test_a_forked_process_makes_other_ids() -> None:
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.write(writing, random_id().bytes)
        os._exit(0)
    os.waitpid(child, 0)
    assert os.read(reading, 16) != random_id().bytes
    os.close(reading)
    os.close(writing)
