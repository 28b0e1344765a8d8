"""Fixtures of the translator's tests: the examples, and projects made of a few lines."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from translator import load

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ("laser_bump_and_go", "visual_follow_person")

ACTION = '''
import py_trees

from tree_gardener.ports import Port


class {name}(py_trees.behaviour.Behaviour):
    """Does {name}."""

    INPUT_PORTS = {{"speed": Port(float, default=0.5), "count": Port(int), "flag": Port(bool)}}
    OUTPUT_PORTS = {{"result": Port(float)}}
    INOUT_PORTS = {{"counter": Port(int)}}

    def update(self):
        return py_trees.common.Status.SUCCESS
'''

OPEN_ACTION = """
import py_trees


class {name}(py_trees.behaviour.Behaviour):
    def __init__(self, name, ports=None):
        super().__init__(name)
        self.ports = ports

    def update(self):
        return py_trees.common.Status.SUCCESS
"""


def example_files(name: str) -> dict[str, bytes]:
    """The files of an example."""
    folder = ROOT / "examples" / name
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and "__pycache__" not in path.parts
    }


def diagram_bytes(nodes, *, root="n1", tree="MainTree", **more) -> bytes:
    """A diagram as a file."""
    document = {"format": "bt-studio/diagram", "version": 1, "id": tree, "root": root, "nodes": nodes, **more}
    return json.dumps(document).encode()


@pytest.fixture(params=EXAMPLES)
def example(request):
    """Each example as a project."""
    return load(example_files(request.param))


@pytest.fixture
def make_project():
    """Makes a project of trees given as dicts of nodes, with the actions `Act` (typed ports) and `Open`."""

    def make(nodes, *, trees=None, actions=None, files=None, **settings):
        sources = {
            "Act": ACTION.format(name="Act"),
            "Open": OPEN_ACTION.format(name="Open"),
            **(actions or {}),
        }
        found = {
            "project.json": json.dumps(
                {"format": "bt-studio/project", "version": 1, "name": "Test", **settings}
            ).encode(),
            "trees/MainTree.json": diagram_bytes(nodes),
            **{f"actions/{name}.py": source.encode() for name, source in sources.items()},
        }
        for name, rows in (trees or {}).items():
            found[f"trees/{name}.json"] = diagram_bytes(rows, tree=name)
        return load({**found, **(files or {})})

    return make


def codes(diagnostics) -> list[str]:
    """The codes of diagnostics, in order."""
    return [item.code for item in diagnostics]
