"""Small projects with evaluations, for tests."""

from __future__ import annotations

import json
from textwrap import dedent
from typing import TYPE_CHECKING

from translator import Project, open_files

if TYPE_CHECKING:
    from pathlib import Path

HEAD = "format: bt-studio/evaluation\nversion: 1\n"
WORLD = """format: bt-studio/universe
version: 1
name: Yard
models:
  - {id: wall, shape: box, size: [0.2, 6, 1], pose: [3, 0, 0.5, 0, 0, 0]}
  - {id: crate, shape: box, size: [0.4, 0.4, 0.4], pose: [-2, 2, 0.2, 0, 0, 0], mass: 2}
  - {id: carpet, shape: plane, size: [2, 2], pose: [0, 0, 0.01, 0, 0, 0], solid: false}
actors:
  - {id: walker, path: [[-3, -3], [3, -3]], speed: 0.5}
robots:
  - {id: rob, model: turtle2}
areas:
  start: {box: [-1, -1, 1, 1]}
  ahead: {polygon: [[1, -1], [2, -1], [2, 1], [1, 1]]}
  behind: {box: [-3, -1, -1.5, 1]}
"""
DRIVE = """import py_trees
from geometry_msgs.msg import Twist
from tree_gardener.ports import Port, get_input


class Drive(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"speed": Port(float, default=0.5), "count": Port(int, default=1)}

    def setup(self, node, **_):
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        twist = Twist()
        twist.linear.x = get_input(self, "speed")
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING
"""


def files(evaluation: str, *, action: str = DRIVE, name: str = "Drive", **others: str) -> dict[str, bytes]:
    """Returns the files of a project with one action; `others` are more files, `__` for a slash."""
    settings = {
        "format": "bt-studio/project",
        "version": 1,
        "name": "Yard",
        "main_tree": "MainTree",
        "universe": "yard",
    }
    tree = {"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "a"}
    tree |= {"nodes": {"a": {"type": name, "name": "go"}}, "drafts": []}
    texts = {
        "project.json": json.dumps(settings),
        "trees/MainTree.json": json.dumps(tree),
        f"actions/{name}.py": action,
        "universes/yard.yaml": WORLD,
        "evaluations/main.yaml": HEAD + dedent(evaluation),
    }
    texts |= {path.replace("__", "/").replace("_py", ".py"): text for path, text in others.items()}
    return {path: text.encode() for path, text in texts.items()}


def project(evaluation: str, **options: str) -> Project:
    """Returns such a project, read."""
    return open_files(files(evaluation, **options))


def write(folder: Path, evaluation: str, **options: str) -> Path:
    """Writes such a project into a folder."""
    for path, data in files(evaluation, **options).items():
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data)
    return folder
