"""`odom`, `base_footprint`, `base_link`; the covariance of odometry; the ground truth."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rclpy.context import Context
from rclpy.node import Node

from executor.robots import load_robot, robot_ids
from executor.ros import base_frames, messages
from executor.ros.node import WorldNode, take
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld
from executor.world.physics.drive import DifferentialDrive
from executor.world.sensing.sensors import Sensors

OWN = """<robot name="own"><link name="{root}"/>{more}
  <link name="left"/><link name="right"/>
  <joint name="l" type="continuous"><parent link="{root}"/><child link="left"/>
    <origin xyz="0 0.1 {z}"/><axis xyz="0 1 0"/></joint>
  <joint name="r" type="continuous"><parent link="{root}"/><child link="right"/>
    <origin xyz="0 -0.1 {z}"/><axis xyz="0 1 0"/></joint>
</robot>"""
YAML = """format: bt-studio/robot
version: 1
name: Own
urdf: own.urdf
drive: {left: [l], right: [r], wheel_radius: 0.05, track: 0.2, max_linear: 1, max_angular: 2}
"""


def own_robot(folder: Path, root: str, z: float, more: str = "") -> Any:
    at = folder / "robots" / "own"
    at.mkdir(parents=True)
    (at / "own.urdf").write_text(OWN.format(root=root, z=z, more=more))
    (at / "robot.yaml").write_text(YAML)
    return load_robot("own", folder)


def frames_of(config: Any) -> dict[str, tuple[str, float]]:
    """Returns parent and height by child, including the frames of odometry."""
    found = {base_frames.odometry_frame(config): ("odom", 0.0)}
    for each in base_frames.fixed_transforms(config):
        found[each.child_frame_id] = (each.header.frame_id, each.transform.translation.z)
    return found


@pytest.mark.parametrize("robot", robot_ids())
def test_built_in_robots_have_the_frames_of_turtlebot3(robot: str) -> None:
    frames = frames_of(load_robot(robot))
    assert frames["base_footprint"] == ("odom", 0.0)
    assert frames["base_link"] == ("base_footprint", pytest.approx(0.0, abs=0.002))


def test_a_root_at_the_axle_is_above_its_footprint(tmp_path: Path) -> None:
    assert frames_of(own_robot(tmp_path, "base_link", 0.0))["base_link"] == ("base_footprint", 0.05)


def test_a_footprint_of_the_urdf_is_taken(tmp_path: Path) -> None:
    assert frames_of(own_robot(tmp_path, "base_footprint", 0.05)) == {"base_footprint": ("odom", 0.0)}


def test_a_root_of_another_name_hangs_below_base_link(tmp_path: Path) -> None:
    frames = frames_of(own_robot(tmp_path, "hull", 0.02))
    assert frames["base_link"] == ("base_footprint", pytest.approx(0.03))
    assert frames["hull"] == ("base_link", 0.0)


def test_a_footprint_below_the_root_keeps_its_one_parent(tmp_path: Path) -> None:
    more = '<link name="base_footprint"/><joint name="f" type="fixed"><parent link="base_link"/>'
    more += '<child link="base_footprint"/><origin xyz="0 0 -0.05"/></joint>'
    assert frames_of(own_robot(tmp_path, "base_link", 0.0, more)) == {"base_link": ("odom", 0.0)}


def test_the_covariance_is_that_of_many_runs() -> None:
    """The same path, many times with different noise: the scatter of the estimated poses."""
    config = load_robot("burger").drive.model_copy(update={"slip_noise": 0.01})
    ends, told = [], None
    for seed in range(600):
        drive = DifferentialDrive(config, np.random.default_rng(seed))
        left = right = 0.0
        drive.observe(left, right, 0.0)
        for _ in range(60):  # 1.98 m along an arc of 2.5 rad
            left, right = left + 0.9 - 0.1, right + 0.9 + 0.1
            state = drive.observe(left, right, 1 / 60)
        ends.append((state.x, state.y, _unwound(state.yaw)))
        told = state.covariance
    xx, xy, xt, yy, yt, tt = told or (0.0,) * 6
    expected = np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])
    scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
    assert np.cov(np.array(ends).T) / scale == pytest.approx(expected / scale, abs=0.17)


def _unwound(yaw: float) -> float:
    return yaw + 2 * math.pi if yaw < -1 else yaw


def test_the_covariance_grows_with_the_way_and_not_with_time() -> None:
    config = load_robot("burger").drive
    drive = DifferentialDrive(config, np.random.default_rng(1))
    seen = []
    for angle in (0.0, 5.0, 10.0, 20.0, 20.0):
        seen.append(drive.observe(angle, angle, 0.1).covariance)
    assert [each[0] for each in seen[:4]] == sorted({each[0] for each in seen[:4]}), "ever more"
    assert seen[3] == seen[4], "nothing moved"
    assert np.linalg.eigvalsh(_square(seen[3])).min() >= 0


def _square(told: Any) -> Any:
    xx, xy, xt, yy, yt, tt = told
    return np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])


def test_the_message_has_the_covariance_that_filters_read() -> None:
    drive = DifferentialDrive(load_robot("burger").drive, np.random.default_rng(1))
    drive.observe(0.0, 0.0, 0.0)
    state = drive.observe(20.0, 25.0, 1.0)
    matrix = messages.odometry(state, 1.0).pose.covariance.reshape(6, 6)
    assert matrix == pytest.approx(matrix.T)
    planar = matrix[np.ix_([0, 1, 5], [0, 1, 5])]
    assert planar == pytest.approx(_square(state.covariance) + np.diag([1e-6] * 3), abs=1e-12)
    assert np.linalg.eigvalsh(matrix).min() > 0, "filters invert it"


@pytest.fixture
def world() -> Iterator[BulletWorld]:
    made = BulletWorld(load_builtin("empty"), robot="burger")
    yield made
    made.close()


def test_the_true_pose_is_published_only_on_request(world: BulletWorld, context: Context) -> None:
    for asked in ((), ("robot",)):
        sensors = Sensors(world, lambda: pytest.fail("nothing is drawn"))
        node, listener = WorldNode(world, context, true_poses=asked), Node("listener", context=context)
        ear = listener.create_subscription(Odometry, "/ground_truth/odom", print, 10)
        told = None
        for _ in range(90):
            world.robots[0].command(0.2, 0.5)
            world.step(4)
            node.publish(sensors)
            told = take(ear) or told
        if not asked:
            assert told is None
        else:
            assert told is not None
            assert (told.header.frame_id, told.child_frame_id) == ("world", "base_footprint")
            place, twist = told.pose.pose.position, told.twist.twist
            assert (place.x, place.y) == pytest.approx(world.robots[0].pose[:2], abs=0.01)
            assert place.z == pytest.approx(0.0, abs=0.01)
            assert (twist.linear.x, twist.linear.y) == pytest.approx((0.2, 0.0), abs=0.01)
            assert twist.angular.z == pytest.approx(0.5, abs=0.05)
            assert not told.pose.covariance.any()
        node.close()
        listener.destroy_node()
        sensors.close()
