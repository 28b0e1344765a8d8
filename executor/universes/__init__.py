"""Universes: descriptions of simulated worlds, as YAML documents."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from executor.universes.loader import (
        BUILTIN_IDS,
        UniverseError,
        builtin_path,
        load_builtin,
        parse_universe,
    )
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


def __getattr__(name: str) -> Any:
    # The manager also reads documents. It must not import pydantic, which takes longer than all its other
    # imports.
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from executor.universes import loader, model  # noqa: PLC0415

    return getattr(loader, name, None) or getattr(model, name)
