"""The version of a universe: a digest of what it says, so that results can name the world they are of."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from executor.universes.model import Universe

_NOT_OF_THE_WORLD = {"name", "description", "view"}


def version_of(universe: Universe) -> str:
    """Returns eight digits that change when anything of the world does.

    Texts and the view are no part of it, nor are the layout of the document and fields at their defaults, so
    that a new field changes no version.
    """
    said = universe.model_dump_json(exclude_defaults=True, exclude=_NOT_OF_THE_WORLD)
    return hashlib.sha256(said.encode()).hexdigest()[:8]
