"""Reads the catalogue of nodes, universes and robots from files of the other packages."""

from __future__ import annotations

import json
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from backend.config.environment import REPOSITORY
from translator.yaml_text import read_yaml

if TYPE_CHECKING:
    from pathlib import Path

NODES: Final = REPOSITORY / "tree_gardener" / "catalog.json"
UNIVERSES: Final = REPOSITORY / "executor" / "universes"
ROBOTS: Final = REPOSITORY / "executor" / "robots"
OUTSIDE: Final = "none"
OUTSIDE_NAME: Final = "No world: an outside ROS graph"
OUTSIDE_DESCRIPTION: Final = (
    "The program joins the ROS graph of this machine and drives a robot that is not simulated here: "
    "a real one, Gazebo, or a bag that is played."
)


@lru_cache(maxsize=1)
def nodes() -> dict[str, Any]:
    """Returns the catalogue of built-in nodes."""
    catalogue: dict[str, Any] = json.loads(NODES.read_bytes())
    return catalogue


@lru_cache(maxsize=1)
def universes() -> list[dict[str, str]]:
    """Returns the built-in universes by id, and last the outside graph."""
    return [
        *(_entry("universes", path.stem, path) for path in sorted(UNIVERSES.glob("*.yaml"))),
        {"id": OUTSIDE, "name": OUTSIDE_NAME, "description": OUTSIDE_DESCRIPTION, "preview": ""},
    ]


@lru_cache(maxsize=1)
def robots() -> list[dict[str, str]]:
    """Returns the built-in robots by id; each is a folder with its description."""
    return [_entry("robots", path.parent.name, path) for path in sorted(ROBOTS.glob("*/robot.yaml"))]


def universe_preview(universe_id: str) -> Path | None:
    """Returns the path of the picture of a built-in universe, or None."""
    known = {entry["id"] for entry in universes()}
    return UNIVERSES / "previews" / f"{universe_id}.webp" if universe_id in known else None


def universe_text(universe_id: str) -> Path | None:
    """Returns the path of the document of a built-in universe, or None."""
    known = {entry["id"] for entry in universes()}
    return UNIVERSES / f"{universe_id}.yaml" if universe_id in known else None


def robot_config(robot_id: str) -> Path | None:
    """Returns the path of the `robot.yaml` of a built-in robot, or None."""
    known = {entry["id"] for entry in robots()}
    return ROBOTS / robot_id / "robot.yaml" if robot_id in known else None


def robot_urdf(robot_id: str) -> Path | None:
    """Returns the path of the URDF of a built-in robot, or None."""
    known = {entry["id"] for entry in robots()}
    return ROBOTS / robot_id / f"{robot_id}.urdf" if robot_id in known else None


def robot_preview(robot_id: str) -> Path | None:
    """Returns the path of the picture of a built-in robot, or None."""
    known = {entry["id"] for entry in robots()}
    return ROBOTS / robot_id / "preview.webp" if robot_id in known else None


def _entry(kind: str, entry_id: str, path: Path) -> dict[str, str]:
    document = read_yaml(path.read_bytes()).value
    return {
        "id": entry_id,
        "name": str(document.get("name", entry_id)),
        "description": str(document.get("description", "")),
        "preview": f"/api/v1/catalog/{kind}/{entry_id}/preview",
    }
