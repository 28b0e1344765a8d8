"""The wheels of ROS beside a ROS that the shell has sourced."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tree_gardener.ros_wheels import TwoRosError, refuse_two

IMPORTING = ("ros", "ros_commanded", "ros_lifecycle", "ros_node", "ros_server", "ros_spinning")


def sourced(prefix: Path, place: str = "lib/python3.12/site-packages") -> dict[str, str]:
    (prefix / place / "rclpy").mkdir(parents=True)
    return {"AMENT_PREFIX_PATH": f"/nowhere{os.pathsep}{prefix}"}


def wheels(folder: Path) -> list[str]:
    about = folder / "ros_rclpy-7.1.6.dist-info"
    about.mkdir(parents=True)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: ros-rclpy\nVersion: 7.1.6\n")
    (folder / "rclpy").mkdir()
    return [str(folder)]


@pytest.mark.parametrize("place", ["lib/python3.12/site-packages", "local/lib/python3.10/dist-packages"])
def test_both_are_refused_with_their_places(tmp_path, place):
    with pytest.raises(TwoRosError) as refused:
        refuse_two(sourced(tmp_path / "ros", place), wheels(tmp_path / "site"))
    text = str(refused.value)
    assert "\n" not in text
    assert str(tmp_path / "site" / "rclpy") in text
    assert str(tmp_path / "ros" / place / "rclpy") in text


def test_a_sourced_ros_alone_is_right(tmp_path):
    refuse_two(sourced(tmp_path / "ros"), [str(tmp_path)])


def test_the_wheels_alone_are_right(tmp_path):
    paths = wheels(tmp_path)
    refuse_two({}, paths)
    refuse_two({"AMENT_PREFIX_PATH": str(tmp_path / "workspace")}, paths)


def test_a_prefix_that_is_the_place_of_the_wheels_is_no_second_ros(tmp_path):
    site = tmp_path / "lib/python3.12/site-packages"
    refuse_two({"AMENT_PREFIX_PATH": str(tmp_path)}, wheels(site))


@pytest.mark.parametrize("module", IMPORTING)
def test_each_module_that_imports_rclpy_refuses_before(tmp_path, module):
    broken = tmp_path / "first"
    broken.mkdir()
    (broken / "rclpy.py").write_text("raise SystemExit('rclpy was loaded')\n")
    (broken / "geometry_msgs.py").write_text("raise SystemExit('geometry_msgs was loaded')\n")
    paths = os.pathsep.join([str(broken), str(Path(__file__).parents[2])])
    done = subprocess.run(
        [sys.executable, "-c", f"import tree_gardener.{module}"],
        env={**os.environ, **sourced(tmp_path / "ros"), "PYTHONPATH": paths},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1].startswith(
        "tree_gardener.ros_wheels.TwoRosError: rclpy is here twice"
    )


def test_every_module_of_the_engine_that_imports_rclpy_at_once_is_in_the_list():
    folder = Path(__file__).parents[2] / "tree_gardener"
    found = {
        path.stem
        for path in folder.rglob("*.py")
        if any(line.startswith(("import rclpy", "from rclpy")) for line in path.read_text().splitlines())
    }
    assert found <= set(IMPORTING)
    assert len(found) >= 4
