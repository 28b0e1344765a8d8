"""Creates the world that a client requested."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.universes import Universe, load_builtin, parse_universe
from executor.world.physics.bullet import BulletWorld

if TYPE_CHECKING:
    from pathlib import Path


def find_universe(universe: str, file: str = "") -> Universe:
    """Returns a universe by its built-in id, or from its YAML text. `file` is the name of the text in errors.

    Raises:
        UniverseError: there is no such universe, or the text is invalid.
    """
    if "\n" in universe or ":" in universe:
        return parse_universe(universe, file or "universe.yaml")
    return load_builtin(universe)


def make_world(
    universe: str, *, seed: int = 0, robot: str | None = None, assets: Path | None = None, file: str = ""
) -> BulletWorld:
    """Returns the world of a universe. `file` is the name of the universe's text in errors.

    Raises:
        DocumentError: the universe or its robot does not exist or is invalid.
    """
    return BulletWorld(find_universe(universe, file), seed=seed, robot=robot, assets=assets)
