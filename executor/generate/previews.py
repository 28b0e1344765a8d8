"""Draws the pictures of universes, robots and examples: `python -m executor.generate.previews [ID …]`.

The pictures are committed to the repository, so that the start page needs no renderer. Draw a picture again
when its content changed.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

import cv2

from executor.render import Viewpoint, look_at, make_renderer
from executor.robots import robot_ids
from executor.robots.config import preview_path as robot_preview
from executor.universes import BUILTIN_IDS, load_builtin, parse_universe
from executor.universes.loader import preview_path as universe_preview
from executor.world.physics.bullet import BulletWorld

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from executor.render import Renderer
    from executor.universes import Universe

_REPOSITORY: Final = Path(__file__).parents[2]
EXAMPLES: Final = _REPOSITORY / "examples"
EXAMPLE_PICTURES: Final = _REPOSITORY / "frontend/src/features/projects/examples/pictures"
SIZE: Final = (480, 270)
MOST_BYTES: Final = 30_000
FOV: Final = 1.05
SETTLE_STEPS: Final = 480  # until robots stand on their wheels and people walk
_DRAWN_AT: Final = 2  # factor of the drawn size, for smooth edges
_ROBOT_FOV: Final = 0.7
_ROBOT_DISTANCE: Final = 4.6  # in radii, for the height of the picture
_QUALITIES: Final = (86, 78, 70, 60, 45, 30)
_STAGE: Final = """
format: bt-studio/universe
version: 1
name: stage
ground: {color: "#dfe3e8"}
robots: [{id: robot, model: %s}]
lights: [{direction: [-0.45, 0.5, -0.8], intensity: 1.0}]
"""


def universe_picture(renderer: Renderer, universe_id: str) -> bytes:
    """Returns the picture of a universe as WebP."""
    universe = load_builtin(universe_id)
    return _webp(_draw(renderer, universe, look_at(universe.view.eye, universe.view.target, FOV)))


def example_picture(renderer: Renderer, universe_path: Path) -> bytes:
    """Returns the picture of an example's own universe as WebP."""
    universe = parse_universe(universe_path.read_text(encoding="utf-8"))
    return _webp(_draw(renderer, universe, look_at(universe.view.eye, universe.view.target, FOV)))


def own_universes() -> dict[str, Path]:
    """Returns the universes of examples that bring one, by example; the others have a built-in one."""
    found = {}
    for manifest in sorted(EXAMPLES.glob("*/project.json")):
        name = json.loads(manifest.read_bytes())["universe"]
        path = manifest.parent / "universes" / f"{name}.yaml"
        if path.is_file():
            found[manifest.parent.name] = path
    return found


def robot_picture(renderer: Renderer, robot_id: str) -> bytes:
    """Returns the picture of a robot as WebP, from a distance that suits its size."""
    universe = parse_universe(_STAGE % robot_id)
    middle, radius = _ball_round(universe)
    away = radius * _ROBOT_DISTANCE
    eye = (middle[0] + 0.62 * away, middle[1] - 0.66 * away, middle[2] + 0.42 * away)
    return _webp(_draw(renderer, universe, look_at(eye, middle, _ROBOT_FOV)))


def _draw(renderer: Renderer, universe: Universe, view: Viewpoint) -> NDArray[np.uint8]:
    world = BulletWorld(universe)
    world.step(SETTLE_STEPS)
    renderer.load(world.scene)
    picture = renderer.draw(world.poses(), view, SIZE[0] * _DRAWN_AT, SIZE[1] * _DRAWN_AT)
    world.close()
    small: NDArray[np.uint8] = cv2.resize(picture, SIZE, interpolation=cv2.INTER_AREA)
    return small


def _ball_round(universe: Universe) -> tuple[tuple[float, float, float], float]:
    """Returns the center and the radius, in m, of a ball around the robot of a universe."""
    world = BulletWorld(universe)
    world.step(SETTLE_STEPS)
    low, high = world.robots[0].bounds
    world.close()
    middle = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2)
    return middle, math.dist(low, high) / 2


def _webp(picture: NDArray[np.uint8]) -> bytes:
    bgr = cv2.cvtColor(picture, cv2.COLOR_RGB2BGR)
    for quality in _QUALITIES:
        data = cv2.imencode(".webp", bgr, [cv2.IMWRITE_WEBP_QUALITY, quality])[1].tobytes()
        if len(data) <= MOST_BYTES:
            return data
    raise ValueError("a preview does not fit into its size")


def main(arguments: list[str] | None = None) -> None:
    """Draws the named pictures, or all."""
    parser = argparse.ArgumentParser(prog="python -m executor.generate.previews", description=__doc__)
    parser.add_argument("ids", nargs="*", metavar="ID")
    wanted = parser.parse_args(arguments).ids
    renderer = make_renderer()
    for universe_id in BUILTIN_IDS:
        if not wanted or universe_id in wanted:
            _write(universe_preview(universe_id), universe_picture(renderer, universe_id))
    for robot_id in robot_ids():
        if not wanted or robot_id in wanted:
            _write(robot_preview(robot_id), robot_picture(renderer, robot_id))
    for example_id, path in own_universes().items():
        if not wanted or example_id in wanted:
            _write(EXAMPLE_PICTURES / f"{example_id}.webp", example_picture(renderer, path))
    renderer.close()


def _write(path: Path, data: bytes) -> None:
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(data)
    sys.stdout.write(f"{path} {len(data)} bytes\n")


if __name__ == "__main__":
    main()
