"""Makes the world that a client requested."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.universes import Universe, load_builtin, parse_universe
from executor.world.physics.bullet import BulletWorld

if TYPE_CHECKING:
    from pathlib import Path


def find_universe(universe: str, file: str = "") -> Universe:
    """Returns a universe by its built-in id, or from its YAML text; errors in the text name `file`.

    Raises:
        UniverseError: there is none, or the text is invalid.
    """
    if "\n" in universe or ":" in universe:
        return parse_universe(universe, file or "universe.yaml")
    return load_builtin(universe)


def make_world(
    universe: str, *, seed: int = 0, robot: str | None = None, assets: Path | None = None, file: str = ""
) -> BulletWorld:
    """Returns the world of a universe; errors in its text name `file`.

    Raises:
        DocumentError: the universe or its robot does not exist or is invalid.
    """
    return BulletWorld(find_universe(universe, file), seed=seed, robot=robot, assets=assets)
