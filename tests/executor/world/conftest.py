from collections.abc import Callable, Iterator
from typing import Any

import pytest

from executor.universes import load_builtin, parse_universe
from executor.world.physics.bullet import BulletWorld

MakeWorld = Callable[..., BulletWorld]


@pytest.fixture
def make_world() -> Iterator[MakeWorld]:
    """Makes worlds of a built-in id or of a document's lines, and closes them afterwards."""
    made: list[BulletWorld] = []

    def make(universe: str, **options: Any) -> BulletWorld:
        is_text = "\n" in universe
        text = "format: bt-studio/universe\nversion: 1\nname: test\n" + universe
        made.append(BulletWorld(parse_universe(text) if is_text else load_builtin(universe), **options))
        return made[-1]

    yield make
    for world in made:
        world.close()
