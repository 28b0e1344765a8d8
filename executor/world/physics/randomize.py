"""Draws a universe's random values from a seed."""

from __future__ import annotations

import random
from typing import Any

from executor.universes.model import Universe


def draw(universe: Universe, seed: int) -> Universe:
    """Returns a universe in which each value of `random` was drawn; the same seed draws the same values."""
    if not universe.random:
        return universe
    generator = random.Random(seed)  # noqa: S311 - for variety, not for secrets
    document = universe.model_dump()
    things = {thing["id"]: thing for group in ("models", "actors", "robots") for thing in document[group]}
    for key, (low, high) in universe.random.items():
        target, field, index = universe.random_target(key)
        _set(things[target], field, index, generator.uniform(low, high))
    return Universe.model_validate(document)


def _set(thing: dict[str, Any], field: str, index: int, value: float) -> None:
    if index < 0:
        thing[field] = value
        return
    values = list(thing[field])
    values[index] = value
    thing[field] = tuple(values)
