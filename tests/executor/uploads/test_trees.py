"""A Python file with a tree of py_trees becomes a project, or the reason is said."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING

import pytest

from executor.expansion.py_trees_apart import BuildError
from executor.uploads.trees import make_tree, tree_project

if TYPE_CHECKING:
    from pathlib import Path

TREE = """import py_trees

def create_root():
    root = py_trees.composites.Sequence("both", memory=True)
    last = py_trees.behaviours.TickCounter("b", 3, py_trees.common.Status.SUCCESS)
    root.add_children([py_trees.behaviours.Success("a"), last])
    return root
"""


def written(folder: Path, text: str) -> Path:
    file = folder / "robot.py"
    file.write_text(text, encoding="utf-8")
    return file


def test_a_tree_comes_in_as_blocks(tmp_path: Path) -> None:
    answer = make_tree(written(tmp_path, TREE), "")
    files = {file["path"]: base64.b64decode(file["base64"]) for file in answer["files"]}
    assert {"project.json", "trees/MainTree.json", "actions/TickCounter.py", "actions/robot.py"} <= set(files)
    assert b'"Sequence"' in files["trees/MainTree.json"]
    assert answer["one_block"] == ""


def test_it_is_one_block_for_a_stated_reason_where_a_class_has_no_form(tmp_path: Path) -> None:
    text = "import py_trees\n\nroot = py_trees.decorators.EternalGuard('g', "
    text += "py_trees.behaviours.Success('s'), condition=lambda: True)\n"
    project, why = tree_project(written(tmp_path, text), "")
    assert list(project.actions) == ["Robot"]
    assert "EternalGuard of 'g'" in why


def test_several_trees_are_choices(tmp_path: Path) -> None:
    file = written(tmp_path, TREE + "\n\ndef other_tree():\n    return py_trees.behaviours.Success('s')\n")
    with pytest.raises(BuildError, match="several trees") as caught:
        tree_project(file, "")
    assert caught.value.choices == ["create_root", "other_tree"]
    assert make_tree(file, "")["no_tree"]["choices"] == ["create_root", "other_tree"]
    assert make_tree(file, "other_tree")["files"]


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("x = 1\nraise ValueError('no')\n", 2, "ValueError: no"),
        ("x = 1\n", 1, "it makes no tree of py_trees, in a variable or by a function without arguments"),
        ("import socket\n\nsocket.create_connection(('127.0.0.1', 9))\n", 3, "PermissionError"),
    ],
)
def test_what_fails_is_said_with_its_line(tmp_path: Path, text: str, line: int, message: str) -> None:
    found = make_tree(written(tmp_path, text), "")["no_tree"]
    assert (found["file"], found["line"], found["choices"]) == ("robot.py", line, [])
    assert message in found["message"]


def test_long_texts_that_the_file_says_are_cut(tmp_path: Path) -> None:
    found = make_tree(written(tmp_path, "raise ValueError('no' * 20_000)\n"), "")["no_tree"]
    assert found["message"].startswith("ValueError: nono")
    assert len(found["message"]) == 2_000
    name = "t" * 201
    text = f"from py_trees.behaviours import Success\n\na = Success('a')\n{name} = Success('b')\n"
    assert make_tree(written(tmp_path, text), "")["no_tree"]["choices"] == ["a"]
