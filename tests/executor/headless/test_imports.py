"""Imported projects in JdeRobot's style drive in the proposed universe."""

from __future__ import annotations

import json
from functools import partial
from typing import TYPE_CHECKING, Any

import pytest

from tests.budget import count
from tests.cli.typed import studio
from tests.executor.forks import completed
from tests.fakes.jderobot_projects import write_avoider, write_follower, write_racer, write_wanderer

if TYPE_CHECKING:
    import subprocess
    from collections.abc import Callable
    from pathlib import Path

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(400)]


forked = partial(completed, "backend.cli.main")


def run(*how: object) -> subprocess.CompletedProcess[str]:
    return forked("run", *how) if "--lockstep" in how else studio("run", *how)


def drive(folder: Path, write: Callable[[Path], Path], *how: object) -> tuple[dict[str, Any], str]:
    """Imports a project and runs it unchanged; returns its report and its output."""
    project, report = folder / "imported", folder / "report.json"
    done = forked("import", write(folder / "theirs"), "-o", project)
    assert done.returncode == 0, done.stderr
    done = run(project, "--seed", "1", "--report", report, *how)
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


@pytest.mark.parametrize(
    ("write", "universe", "least_m"), [(write_racer, "circuit", 50), (write_avoider, "circuit_obstacles", 12)]
)
def test_projects_for_the_f1_find_their_circuit_and_drive_on_it(
    tmp_path: Path, write: Callable[[Path], Path], universe: str, least_m: float
) -> None:
    report, _ = drive(tmp_path, write, "--lockstep", "--duration", "10")
    assert json.loads((tmp_path / "imported" / "project.json").read_text())["universe"] == universe
    assert report["distance_m"] > least_m
    assert (report["collisions"], report["errors"]) == (0, [])


def test_an_order_of_children_that_never_turns_is_said_and_the_offered_one_drives(tmp_path: Path) -> None:
    theirs, project = write_wanderer(tmp_path / "theirs", "top-to-bottom"), tmp_path / "imported"
    done = forked("import", theirs, "-o", tmp_path / "as_it_is")
    assert "“ReactiveFallback” is never ticked" in done.stderr
    assert "--order bottom-to-top" in done.stderr
    done = forked("import", theirs, "-o", project, "--order", "bottom-to-top")
    assert "never ticked" not in done.stderr
    report = tmp_path / "report.json"
    assert run(project, "--lockstep", "--duration", "20", "--report", report).returncode == 0
    drove = json.loads(report.read_text())
    assert (drove["distance_m"] > 3, drove["collisions"]) == (True, 0)


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
    done = forked("import", theirs, "-o", tmp_path / "imported")
    assert "To be written: actions/Advance.py, actions/Rotate.py" in done.stdout
    done = run(tmp_path / "imported", *how, "--duration", "2")
    assert done.returncode == 1
    assert "Advance and Rotate are unwritten stubs, which always fail" in done.stdout + done.stderr
    assert "actions/Advance.py:1:1: stub Advance is an unwritten stub" in done.stderr
    assert "actions/Rotate.py:1:1: stub" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_stub_that_no_running_tree_uses_is_not_reported(tmp_path: Path) -> None:
    done = forked("import", write_wanderer(tmp_path / "theirs"), "-o", tmp_path / "imported")
    stub = tmp_path / "imported" / "actions" / "Later.py"
    stub.write_text(
        "import py_trees\n\n\nclass Later(py_trees.behaviour.Behaviour):\n"
        '    """bt-studio: to be written."""\n\n'
        "    def update(self):\n        return py_trees.common.Status.FAILURE\n"
    )
    done = run(tmp_path / "imported", "--lockstep", "--duration", "1")
    assert (done.returncode, done.stderr) == (0, "")
