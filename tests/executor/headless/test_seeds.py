"""`run --seed` determines all random values, also in processes with different hash seeds."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from executor.application.randomness import seed_randomness

ROOT = Path(__file__).parents[3]
ROBOT = ROOT / "executor" / "robots" / "turtle2"
pytestmark = [pytest.mark.simulation, pytest.mark.timeout(300)]

DRAW = """import random
import numpy as np
import py_trees
AT_IMPORT = random.random()


class Draw(py_trees.behaviour.Behaviour):
    def update(self):
        texts = {"alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta"}
        print("drew", AT_IMPORT, random.random(), np.random.rand(), *texts)
        return py_trees.common.Status.SUCCESS
"""
IDLE = """import py_trees


class Idle(py_trees.behaviour.Behaviour):
    def update(self):
        return py_trees.common.Status.RUNNING
"""
SCAN = """import py_trees
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Scan(py_trees.behaviour.Behaviour):
    def setup(self, node, **_):
        self.subscription = node.create_subscription(LaserScan, "/scan", self.heard, qos_profile_sensor_data)
        self.text = ""

    def heard(self, message):
        self.text = f"heard {list(message.ranges)}"

    def update(self):
        print(self.text)
        return py_trees.common.Status.RUNNING
"""


def project(folder: Path, name: str, source: str, robot: str = "turtle2") -> Path:
    settings = {"format": "bt-studio/project", "version": 1, "name": name, "main_tree": "MainTree"}
    settings |= {"universe": "walled_room", "robot": robot}
    tree = {"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "a"}
    tree |= {"nodes": {"a": {"type": name}}}
    for path, text in {
        "project.json": json.dumps(settings),
        "trees/MainTree.json": json.dumps(tree),
        f"actions/{name}.py": source,
    }.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    return folder


def run(folder: Path, seed: int, hash_seed: str) -> tuple[str, dict[str, Any]]:
    """Returns the output of the actions, with the last line separate, and the report without real times."""
    report = folder.with_suffix(f".{seed}.json")
    command = [str(Path(sys.executable).with_name("bt-studio")), "run", str(folder), "--lockstep"]
    done = subprocess.run(
        [*command, "--duration", "1", "--seed", str(seed), "--report", str(report)],
        env={**os.environ, "PYTHONHASHSEED": hash_seed},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    numbers = json.loads(report.read_text())
    for name in ("wall_time_s", "real_time_factor", "tick_ms", "overruns"):
        del numbers[name]
    lines = [line for line in done.stdout.splitlines() if " simulated in " not in line]
    return "\n".join(lines), numbers


def test_the_same_seed_draws_the_same_in_every_process(tmp_path: Path) -> None:
    folder = project(tmp_path / "draw", "Draw", DRAW)
    first, report = run(folder, 7, "1")
    assert "drew" in first
    assert report["random"]
    assert run(folder, 7, "2") == (first, report)
    other, _ = run(folder, 8, "1")
    drawn, again = first.split(), other.split()
    assert all(one != two for one, two in zip(drawn[1:4], again[1:4], strict=True))
    assert drawn[4:12] == again[4:12], "the hashes of texts do not depend on the seed"


def test_the_seed_reaches_the_actions_in_real_time_too(tmp_path: Path) -> None:
    folder = project(tmp_path / "draw", "Draw", DRAW)
    first, _ = run(folder, 7, "1")
    command = [str(Path(sys.executable).with_name("bt-studio")), "run", str(folder), "--duration", "1"]
    live = subprocess.run([*command, "--seed", "7"], capture_output=True, text=True, check=True)
    drawn = live.stdout[live.stdout.index("drew ") :].split()
    assert drawn[1:4] == first.split()[1:4]


def test_measurements_of_the_default_robot_depend_on_the_seed(tmp_path: Path) -> None:
    folder = project(tmp_path / "scan", "Scan", SCAN)
    first, report = run(folder, 1, "1")
    assert "heard [" in first
    assert run(folder, 1, "random") == (first, report)
    other, _ = run(folder, 2, "1")
    assert other != first


def test_a_run_without_randomness_reports_that_once(tmp_path: Path) -> None:
    folder = project(tmp_path / "idle", "Idle", IDLE, robot="quiet")
    shutil.copytree(ROBOT, folder / "robots" / "quiet")
    model = folder / "robots" / "quiet" / "robot.yaml"
    lines = [line for line in model.read_text().splitlines() if "slip_noise" not in line]
    model.write_text("\n".join(lines).replace(", noise_m: 0.01", "") + "\n")
    said, report = run(folder, 3, "1")
    assert said.count("Nothing in this run was random: every seed gives the same.") == 1
    assert not report["random"]
    assert run(folder, 4, "1") == (said, report)
    drawing, report = run(project(tmp_path / "quiet_draw", "Draw", DRAW), 3, "1")
    assert "Nothing in this run was random" not in drawing
    assert report["random"]


@pytest.mark.parametrize("seed", [0, 2**32, 2**63, -1])
def test_every_seed_seeds_both(seed: int) -> None:
    import random

    import numpy as np

    def draw() -> tuple[float, float]:
        randomness = seed_randomness(seed)
        assert randomness.is_untouched
        drawn = random.random(), float(np.random.rand())  # noqa: S311
        assert not randomness.is_untouched
        return drawn

    assert draw() == draw()
