"""The world that a client requests."""

from __future__ import annotations

import pytest

from executor.universes import UniverseError
from executor.world.simulation.launch import find_universe, make_world

TEXT = "format: bt-studio/universe\nversion: 1\nname: yard\n"


def test_a_universe_is_found_by_its_id_or_read_from_its_text() -> None:
    assert find_universe("walled_room").name == "Walled room"
    assert find_universe(TEXT).name == "yard"
    with pytest.raises(UniverseError):
        find_universe("no_such_room")
    world = make_world(TEXT, seed=3)
    assert world.time_s == 0
    world.close()
