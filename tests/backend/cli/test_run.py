"""Runs start the launch nodes of a project, or name those that they leave out."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.deadline import DEADLINE_S

ROOT = Path(__file__).parents[3]
PROGRAM = str(Path(sys.executable).with_name("bt-studio"))
PLACE = "launch/extra_launch.yaml:2"
LEFT_OUT = f"{PLACE}:1: the launch node talker is left out: it runs in real time"
pytestmark = pytest.mark.simulation


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "project"
    shutil.copytree(ROOT / "examples" / "laser_bump_and_go", folder)
    (folder / "launch").mkdir()
    (folder / "launch" / "talker.py").write_text("print('hello', flush=True)\nwhile True: pass\n")
    (folder / "launch" / "extra_launch.yaml").write_text(
        "launch:\n- node: {exec: launch/talker.py, name: talker}\n- node: {pkg: no_such, exec: other}\n"
    )
    return folder


def said(*arguments: str | Path) -> str:
    done = subprocess.run(
        [PROGRAM, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=DEADLINE_S,
        check=True,
    )
    return done.stdout


def test_a_run_in_real_time_starts_them_and_says_what_they_print(project: Path) -> None:
    lines = said("run", project, "--duration", "3").splitlines()
    assert f"{PLACE}: the launch node talker is started" in lines
    assert f"[{PLACE}] hello" in lines
    assert any("launch/extra_launch.yaml:3: other cannot be started" in line for line in lines)


@pytest.mark.parametrize("command", ["run", "one", "test", "evaluate"])
def test_a_run_in_simulated_time_names_those_that_it_leaves_out(project: Path, command: str) -> None:
    arguments: dict[str, tuple[str | Path, ...]] = {
        "run": ("run", project, "--lockstep", "--duration", "0.1"),
        "one": ("run", project, "--evaluation", "room", "--seed", "0"),
        "test": ("test", project),
        "evaluate": ("evaluate", project, "--runs", "1"),
    }
    assert LEFT_OUT in said(*arguments[command])


@pytest.mark.parametrize("how", [["--lockstep"], []])
def test_a_subscription_to_what_nobody_publishes_is_reported_with_its_place(
    project: Path, how: list[str]
) -> None:
    action = project / "actions" / "CheckObstacle.py"
    action.write_text(action.read_text().replace('"/scan"', '"/lidar/scan"'))
    shutil.rmtree(project / "launch")
    [line] = [line for line in said("run", project, "--duration", "9", *how).splitlines() if "/lidar" in line]
    assert line.startswith("actions/CheckObstacle.py:24:1: /lidar/scan: Nothing arrives: ")
    assert line.endswith(
        "sensor_msgs/msg/LaserScan is published on /scan: subscribe to that, or remap the name."
    )
