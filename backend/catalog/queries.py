"""What projects are built from: nodes, universes, robots. Read from the files that the other parts own."""

from __future__ import annotations

import json
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

import yaml

from backend.config.environment import REPOSITORY

if TYPE_CHECKING:
    from pathlib import Path

NODES: Final = REPOSITORY / "tree_gardener" / "catalog.json"
UNIVERSES: Final = REPOSITORY / "executor" / "universes"
ROBOTS: Final = REPOSITORY / "executor" / "robots"


@lru_cache(maxsize=1)
def nodes() -> dict[str, Any]:
    """The catalogue of built-in nodes, as it is on disk."""
    catalogue: dict[str, Any] = json.loads(NODES.read_bytes())
    return catalogue


@lru_cache(maxsize=1)
def universes() -> list[dict[str, str]]:
    """The built-in universes, by id."""
    return [_universe(path) for path in sorted(UNIVERSES.glob("*.yaml"))]


def _universe(path: Path) -> dict[str, str]:
    document = yaml.safe_load(path.read_text(encoding="utf-8"))
    return {
        "id": path.stem,
        "name": str(document.get("name", path.stem)),
        "description": str(document.get("description", "")),
    }


@lru_cache(maxsize=1)
def robots() -> list[dict[str, str]]:
    """The built-in robots, by id: each is a folder with its description."""
    return [_robot(path) for path in sorted(ROBOTS.iterdir()) if path.is_dir() and any(path.glob("*.yaml"))]


def _robot(path: Path) -> dict[str, str]:
    document = yaml.safe_load(min(path.glob("*.yaml")).read_text(encoding="utf-8"))
    return {
        "id": path.name,
        "name": str(document.get("name", path.name)),
        "description": str(document.get("description", "")),
    }
