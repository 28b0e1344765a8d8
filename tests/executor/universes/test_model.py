"""Universes as documents."""

from __future__ import annotations

import pytest

from executor.universes import UniverseError, parse_universe
from executor.universes.model import TEXTURES, Universe

HEAD = "format: bt-studio/universe\nversion: 1\nname: test\n"


def test_a_universe_has_defaults() -> None:
    universe = parse_universe(HEAD)
    assert isinstance(universe, Universe)
    assert universe.models == ()
    assert universe.ceiling is None
    assert TEXTURES


@pytest.mark.parametrize("wrong", ["models: [{id: a}]\n", "colour: red\n", "models: 5\n"])
def test_what_makes_no_sense_is_refused(wrong: str) -> None:
    with pytest.raises(UniverseError):
        parse_universe(HEAD + wrong)
