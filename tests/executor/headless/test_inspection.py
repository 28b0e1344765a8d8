"""Errors of a project's own universes and launch files are found before a run."""

from __future__ import annotations

import json

import pytest

from executor.headless.inspection import launch_notes, problems_of
from translator import load

TREE = json.dumps(
    {"format": "bt-studio-tree", "version": 1, "id": "Main", "root": None, "nodes": {}}
).encode()
UNIVERSE = b"format: bt-studio-universe\nversion: 1\nname: Yard\nsize: [4, 4]\n"


def problems(**files: bytes) -> list[str]:
    named = {path.replace("__", "/"): data for path, data in files.items()}
    return problems_of(load({"project.json": b"{}", "trees/Main.bt.json": TREE, **named}))


def test_a_project_without_parts_of_its_own_has_none():
    assert problems() == []


@pytest.mark.parametrize(
    ("path", "text", "line"),
    [
        (
            "universes/yard.yaml",
            b"name: x\nthings: 3\n",
            "universes/yard.yaml:2:9: BTU003 things is not known",
        ),
        ("universes/yard.yaml", b"a: \xff\n", "universes/yard.yaml:1:1: BTU001 the document is not UTF-8"),
        (
            "launch/a_launch.xml",
            b"<launch>\n<nod/></launch>",
            "launch/a_launch.xml:2:1: BTL001 there is no action",
        ),
    ],
)
def test_what_a_run_refuses_is_found_with_its_place(path, text, line):
    assert any(each.startswith(line) for each in problems(**{path: text})), problems(**{path: text})


def test_launch_nodes_that_cannot_start_are_notes():
    files = {"launch/a_launch.xml": b"<launch>\n<node exec='none.py'/>\n<timer period='1'/></launch>"}
    left, refused = launch_notes(files)
    assert left == "launch/a_launch.xml:3:1: `timer` is left out"
    assert refused.startswith("launch/a_launch.xml:2:1: none cannot be started: there is no file 'none.py'")
    assert launch_notes({"launch/a_launch.xml": b"<"}) == []
