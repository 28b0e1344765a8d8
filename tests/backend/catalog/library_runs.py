"""Runs every behaviour of the library in a suitable world, and prints the results as JSON.

It is a separate process: ROS reads its environment once, and the runs share modules that load slowly.
"""

from __future__ import annotations

import contextlib
import json
import sys
from typing import Any

import yaml

from backend.catalog.library import files_of
from executor.headless.lockstep import LockstepOptions, run_lockstep

Models = list[dict[str, Any]]


def box(name: str, pose: list[float], size: list[float], color: str, **more: Any) -> dict[str, Any]:
    return {"id": name, "shape": "box", "size": size, "pose": [*pose, 0, 0, 0], "color": color, **more}


WALLS: Models = [
    box("north", [0, 2.5, 0.3], [5, 0.1, 0.6], "#8899aa"),
    box("south", [0, -2.5, 0.3], [5, 0.1, 0.6], "#8899aa"),
    box("east", [2.5, 0, 0.3], [0.1, 5, 0.6], "#8899aa"),
    box("west", [-2.5, 0, 0.3], [0.1, 5, 0.6], "#8899aa"),
]
GREEN_BEHIND: Models = [box("post", [-1.5, -1.0, 0.5], [0.3, 0.3, 1.0], "#20c020")]
GREEN_AHEAD: Models = [box("post", [2.5, 0.4, 0.5], [0.3, 0.3, 1.0], "#20c020")]
STATION: Models = [box("station", [-2.0, 0.5, 0.4], [0.5, 0.5, 0.8], "#d02020")]
CRATE: Models = [box("crate", [1.0, 0.3, 0.1], [0.2, 0.2, 0.2], "#b08040", mass=0.4, friction=0.4)]
LINE: Models = [
    {"id": f"line{i}", "shape": "plane", "size": [1.05, 0.09], "color": "#141414", "solid": False,
     "pose": [0.5 + i * 0.98, 0.06 * i * i, 0.004, 0, 0, 0.12 * i]}
    for i in range(4)
]  # fmt: skip

# For each behaviour: its name, its ports, the models of the world, and the limit of its run in simulated s.
RUNS: tuple[tuple[str, dict[str, str], Models, float], ...] = (
    ("DriveForward", {"distance": "1.5", "speed": "0.4"}, [], 12),
    ("TurnBy", {"angle": "-270.0", "speed": "1.2"}, [], 12),
    ("RotateTo", {"heading": "135.0", "speed": "1.2"}, [], 10),
    ("GoTo", {"x": "-1.0", "y": "1.0", "speed": "0.5"}, [], 15),
    ("WallFollowing", {"side": "left", "distance": "0.6", "speed": "0.4"}, WALLS, 22),
    ("ObstacleAvoidance", {"distance": "0.8", "speed": "0.4"}, WALLS, 20),
    ("LineFollowing", {"speed": "0.4"}, LINE, 8),
    ("ColorFollowing", {"color": "#20c020", "near": "0.9", "speed": "0.5"}, GREEN_AHEAD, 12),
    ("SearchColor", {"color": "#20c020", "speed": "0.9", "timeout": "15.0"}, GREEN_BEHIND, 10),
    ("PersonInSight", {"color": "#20c020", "offset": "{o}", "height": "{h}"}, GREEN_AHEAD, 2),
    ("Patrol", {"waypoints": "1,0; 1,1; 0,0", "rounds": "1", "speed": "0.6"}, [], 25),
    ("Docking", {"color": "#d02020", "distance": "0.4"}, STATION, 25),
    ("PushObject", {"object_x": "1.0", "object_y": "0.3", "goal_x": "1.8", "goal_y": "0.3"}, CRATE, 30),
    ("WaitTopic", {"topic": "/scan", "timeout": "5.0"}, [], 6),
)  # fmt: skip


def project(behaviour: str, ports: dict[str, str], models: Models) -> dict[str, bytes]:
    """Returns a project whose main tree waits for the first pictures, and then is the behaviour."""
    manifest = {
        "format": "bt-studio/project", "version": 1, "name": "run", "main_tree": "Main", "tick_hz": 20,
        "universe": "here", "on_finish": "stop", "on_error": "stop",
    }  # fmt: skip
    tree = {
        "format": "bt-studio/diagram", "version": 1, "id": "Main", "root": "n1", "drafts": [],
        "nodes": {
            "n1": {"type": "Sequence", "children": ["n2", "n3"]},
            "n2": {"type": "Sleep", "ports": {"msec": "200"}},
            "n3": {"type": "SubTree", "tree": behaviour, "ports": ports},
        },
    }  # fmt: skip
    world = {
        "format": "bt-studio/universe", "version": 1, "name": "Here", "models": models,
        "ground": {"color": "#e9e6df", "friction": 0.9},
        "robots": [{"id": "robot", "model": "turtle2", "pose": [0, 0, 0, 0, 0, 0]}],
    }  # fmt: skip
    own = {path: text.encode() for path, text in files_of(behaviour).items()}
    return {
        "project.json": json.dumps(manifest).encode(),
        "trees/Main.json": json.dumps(tree).encode(),
        "universes/here.yaml": yaml.safe_dump(world).encode(),
        **own,
    }


def main() -> None:
    results = {}
    for behaviour, ports, models, duration_s in RUNS:
        if sys.argv[1:] and behaviour not in sys.argv[1:]:
            continue
        bodies: dict[str, Any] = {}

        def watch(world: Any, _tree: Any, bodies: dict[str, Any] = bodies) -> None:
            poses = world.poses()
            for each, pose in zip(world.scene.objects, poses, strict=True):
                if each.body in {"crate", "station"}:
                    bodies[each.body] = [float(value) for value in pose[:3]]

        with contextlib.redirect_stdout(sys.stderr):
            report = run_lockstep(
                project(behaviour, ports, models), LockstepOptions(duration_s=duration_s, seed=1), watch=watch
            )
        results[behaviour] = {**report.to_json(), "bodies": bodies}
    print(json.dumps(results))  # noqa: T201 - the result


main()
