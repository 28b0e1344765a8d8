"""A shell that has sourced a ROS, and commands that would load that of the wheels."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from backend.cli.main import ON_ROS, VERBS
from backend.cli.shared.errors import CliError
from backend.cli.shared.one_ros import require_one_ros


@pytest.fixture
def sourced(tmp_path, monkeypatch):
    (tmp_path / "lib/python3.12/site-packages/rclpy").mkdir(parents=True)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    monkeypatch.delitem(sys.modules, "tree_gardener.ros_wheels", raising=False)


def test_two_are_refused_in_a_sentence(sourced):
    with pytest.raises(CliError, match=r"rclpy is here twice, in the wheels .* use a shell"):
        require_one_ros()


def test_one_is_not(monkeypatch):
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    require_one_ros()


@pytest.mark.parametrize(("command", "status"), [(["run", "none"], 1), (["new", "--help"], 0)])
def test_only_commands_that_load_ros_ask(sourced, command, status):
    done = subprocess.run(
        [sys.executable, "-m", "backend.cli.main", *command],
        env=dict(os.environ),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == status
    assert done.stderr.count("rclpy is here twice") == status
    assert "Traceback" not in done.stderr


def test_the_commands_that_ask_exist():
    assert set(VERBS) > ON_ROS
