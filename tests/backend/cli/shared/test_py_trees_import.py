"""A file with a tree of py_trees comes in with the modules beside it, and with nothing else."""

from __future__ import annotations

import pytest

from backend.cli.shared.errors import CliError
from backend.cli.shared.py_trees_import import py_trees_project

TREE = "import py_trees\nimport speeds\n\nroot = py_trees.behaviours.Success('s')\n"


def test_the_modules_beside_the_file_come_along(tmp_path):
    (tmp_path / "robot.py").write_text(TREE)
    (tmp_path / "speeds.py").write_text("FAST = 1\n")
    (tmp_path / "other.py").write_text("x = 1\n")
    project = py_trees_project(tmp_path / "robot.py", "")
    assert {"actions/robot.py", "actions/speeds.py"} <= set(project.files)
    assert "actions/other.py" not in project.files


def test_a_module_in_a_folder_is_refused_with_its_name(tmp_path):
    (tmp_path / "speeds").mkdir()
    (tmp_path / "speeds" / "__init__.py").write_text("")
    (tmp_path / "robot.py").write_text(TREE)
    with pytest.raises(CliError, match=r"it imports speeds/__init__\.py"):
        py_trees_project(tmp_path / "robot.py", "")
