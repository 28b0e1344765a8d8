"""Packages for each ROS distribution."""

from __future__ import annotations

import pytest
import yaml
from catkin_pkg.package import parse_package

from tests.cli.typed import ROOT
from translator import load, to_ros2_package
from translator.archive import read_folder
from translator.importer import from_xml
from translator.nav2.change import changed
from translator.nav2.distributions import DISTRIBUTIONS

NAV2 = """<root BTCPP_format="4"><BehaviorTree ID="Nav"><RecoveryNode number_of_retries="2">
<ComputePathToPose goal="1;0;0" path="{path}"/><ClearEntireCostmap service_name="clear"/></RecoveryNode>
</BehaviorTree></root>"""


def project(name: str):
    if name == "nav2":
        return dict(from_xml(NAV2).files)
    return dict(read_folder(ROOT / "examples" / name))


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
@pytest.mark.parametrize("name", ["laser_bump_and_go", "visual_follow_person", "nav2"])
def test_a_package_is_read_and_says_for_which_it_is(name, distribution, tmp_path) -> None:
    files = project(name)
    change = changed(files, distribution)
    assert (change.lacks, change.kept) == ([], [])
    now = {path: raw for path, raw in {**files, **change.files}.items() if raw is not None}
    package = to_ros2_package(load(now))
    (tmp_path / "package.xml").write_bytes(package.files[f"{package.name}/package.xml"])
    read = parse_package(str(tmp_path / "package.xml"))
    assert {item.name for item in read.exec_depends} >= {"rclpy", "py_trees", "tree_gardener"}
    assert ("nav2_msgs" in {item.name for item in read.exec_depends}) == (name == "nav2")
    assert f"ROS 2 {distribution.capitalize()}" in package.files[f"{package.name}/README.md"].decode()
    workflows = [yaml.safe_load(raw) for path, raw in package.files.items() if path.startswith(".github/")]
    assert [each["jobs"]["colcon"]["container"] for each in workflows] == [f"ros:{distribution}"] * len(
        workflows
    )
    assert workflows or name == "nav2"
