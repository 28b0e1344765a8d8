"""Imported projects in JdeRobot's style drive in the proposed universe."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from tests.budget import count
from tests.cli.typed import studio
from tests.fakes.jderobot_projects import write_follower, write_wanderer

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(400)]


def drive(folder: Path, write: Callable[[Path], Path], *how: object) -> tuple[dict[str, Any], str]:
    """Imports a project and runs it unchanged; returns its report and its output."""
    project, report = folder / "imported", folder / "report.json"
    done = studio("import", write(folder / "theirs"), "-o", project)
    assert done.returncode == 0, done.stderr
    done = studio("run", project, "--seed", "1", "--report", report, *how)
    assert done.returncode == 0, done.stderr
    return json.loads(report.read_text()), done.stdout + done.stderr


@pytest.mark.parametrize(
    ("write", "universe"),
    [(write_follower, "person_in_green"), (write_wanderer, "walled_room")][: count("headless_imports")],
)
def test_imported_projects_drive_in_lock_step(
    tmp_path: Path, write: Callable[[Path], Path], universe: str
) -> None:
    report, said = drive(tmp_path, write, "--lockstep", "--duration", "60")
    assert json.loads((tmp_path / "imported" / "project.json").read_text())["universe"] == universe
    assert report["distance_m"] > 5
    assert report["collisions"] == 0
    assert report["errors"] == []
    assert "Nothing arrives" not in said


def test_an_imported_project_drives_in_real_time(tmp_path: Path) -> None:
    report, said = drive(tmp_path, write_wanderer, "--duration", "25")
    assert report["distance_m"] > 5
    assert report["collisions"] == 0
    assert report["errors"] == []
    # The first ticks are before the first scan.
    assert said.count("returned Status.INVALID, which counts as FAILURE") <= 1


def test_pictures_reach_an_imported_project_in_real_time(tmp_path: Path) -> None:
    report, _ = drive(tmp_path, write_follower, "--duration", "12")
    counts = {node["path"].split("::")[0]: node for node in report["nodes"]}
    assert counts["SeesGreen"]["success"] > 100
    assert report["distance_m"] > 1
    assert report["collisions"] == 0


@pytest.mark.parametrize("how", [["--lockstep"], []])
def test_unwritten_stubs_are_named_and_end_with_status_1(tmp_path: Path, how: list[str]) -> None:
    theirs = write_wanderer(tmp_path / "theirs")
    for action in ("Advance", "Rotate"):
        (theirs / "code" / "actions" / f"{action}.py").unlink()
    done = studio("import", theirs, "-o", tmp_path / "imported")
    assert "To be written: actions/Advance.py, actions/Rotate.py" in done.stdout
    done = studio("run", tmp_path / "imported", *how, "--duration", "2")
    assert done.returncode == 1
    assert "Advance and Rotate are unwritten stubs, which always fail" in done.stdout + done.stderr
    assert "actions/Advance.py:1:1: stub Advance is an unwritten stub" in done.stderr
    assert "actions/Rotate.py:1:1: stub" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_stub_that_no_running_tree_uses_is_not_reported(tmp_path: Path) -> None:
    done = studio("import", write_wanderer(tmp_path / "theirs"), "-o", tmp_path / "imported")
    stub = tmp_path / "imported" / "actions" / "Later.py"
    stub.write_text(
        "import py_trees\n\n\nclass Later(py_trees.behaviour.Behaviour):\n"
        '    """bt-studio: to be written."""\n\n'
        "    def update(self):\n        return py_trees.common.Status.FAILURE\n"
    )
    done = studio("run", tmp_path / "imported", "--lockstep", "--duration", "1")
    assert (done.returncode, done.stderr) == (0, "")
