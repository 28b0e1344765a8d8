"""Universes: the worlds that robots live in, as YAML documents."""

from executor.universes.loader import BUILTIN_IDS, UniverseError, builtin_path, load_builtin, parse_universe
from executor.universes.model import Actor, Ground, Light, Model, RobotPlace, Universe

__all__ = [
    "BUILTIN_IDS",
    "Actor",
    "Ground",
    "Light",
    "Model",
    "RobotPlace",
    "Universe",
    "UniverseError",
    "builtin_path",
    "load_builtin",
    "parse_universe",
]
