"""Makes a world of what a client asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.universes import Universe, load_builtin, parse_universe
from executor.world.bullet import BulletWorld

if TYPE_CHECKING:
    from pathlib import Path


def find_universe(universe: str) -> Universe:
    """Returns a universe by its built-in id, or from its YAML text.

    Raises:
        UniverseError: there is none, or the text is wrong.
    """
    if "\n" in universe or ":" in universe:
        return parse_universe(universe)
    return load_builtin(universe)


def make_world(
    universe: str, *, seed: int = 0, robot: str | None = None, assets: Path | None = None
) -> BulletWorld:
    """Returns the world of a universe.

    Raises:
        DocumentError: the universe or its robot does not exist or is wrong.
    """
    return BulletWorld(find_universe(universe), seed=seed, robot=robot, assets=assets)
