"""Truth of a joint with a motor: the camera of the lookout pans to its target, and sees what is there."""

import math
from pathlib import Path

import pytest

from executor.render import Viewpoint
from executor.robots import RobotError, load_robot
from executor.world.geometry.transforms import yaw_of
from executor.world.physics.bullet import BulletWorld
from tests.executor.world.conftest import MakeWorld

TEXT = "robots: [{id: robot, model: lookout, pose: [1, 0.5, 0, 0, 0, 0.4]}]\n"


def pan(world: BulletWorld) -> tuple[float, float]:
    return world.robots[0].joint_states()["pan_joint"]


def test_the_camera_pans_at_its_rate_and_stays_there(make_world: MakeWorld) -> None:
    world = make_world(TEXT)
    robot = world.robots[0]
    world.step(120)
    start = robot.pose
    assert robot.command_joint("pan_joint", 1.2)
    world.step(72)  # 0.3 s at 2 rad/s
    angle, rate = pan(world)
    assert angle == pytest.approx(0.6, abs=0.06)
    assert rate == pytest.approx(2.0, rel=0.05)
    world.step(240)
    assert pan(world) == pytest.approx((1.2, 0.0), abs=0.002)
    [camera] = robot.config.cameras
    pose = robot.camera_pose(camera)
    assert yaw_of(pose[3:]) == pytest.approx(robot.pose[2] + pan(world)[0], abs=0.002)
    assert math.dist(robot.pose[:2], start[:2]) < 0.002  # panning does not push the robot about
    world.close()


def test_a_known_point_is_where_the_panned_camera_must_see_it(make_world: MakeWorld) -> None:
    world = make_world(TEXT)
    robot = world.robots[0]
    robot.command_joint("pan_joint", -1.0)
    world.step(480)
    [camera] = robot.config.cameras
    pose = robot.camera_pose(camera)
    view = Viewpoint.of_pose(pose, camera.fov, camera.near, camera.far)
    yaw = robot.pose[2] - 1.0
    # Three metres ahead of the lens and half a metre to its left, by the robot's true pose.
    mast = (-0.02 * math.cos(robot.pose[2]), -0.02 * math.sin(robot.pose[2]))
    ahead = 0.05 + 3.0
    point = [
        robot.pose[0] + mast[0] + ahead * math.cos(yaw) - 0.5 * math.sin(yaw),
        robot.pose[1] + mast[1] + ahead * math.sin(yaw) + 0.5 * math.cos(yaw),
        pose[2],
        1.0,
    ]
    x, _, _, w = view.projection_matrix(camera.width, camera.height) @ view.view_matrix() @ point
    focal = camera.width / 2 / math.tan(camera.fov / 2)
    assert (x / w + 1) / 2 * camera.width == pytest.approx(camera.width / 2 - focal * 0.5 / 3.0, abs=1.0)
    world.close()


def test_limits_hold_nonsense_is_refused_and_a_saved_world_pans_on(make_world: MakeWorld) -> None:
    world = make_world(TEXT)
    robot = world.robots[0]
    assert not robot.command_joint("pan_joint", math.nan)
    robot.command_joint("pan_joint", 9.0)
    world.step(120)
    saved, before = world.save(), pan(world)
    world.step(480)
    end = pan(world)
    assert end[0] == pytest.approx(2.6, abs=0.003)
    robot.command_joint("pan_joint", -1.0)
    world.restore(saved)
    assert pan(world) == pytest.approx(before, abs=1e-5)
    world.step(480)
    assert pan(world)[0] == pytest.approx(end[0], abs=1e-4)
    world.reset()
    world.step(240)
    assert pan(world)[0] == pytest.approx(0.0, abs=0.002)
    world.close()


@pytest.mark.parametrize(
    ("joint", "message"),
    [("wheel_left_joint", "drives a wheel"), ("camera_joint", "is fixed"), ("pam_joint", "mean 'pan_joint'")],
)
def test_a_joint_that_no_motor_can_hold_is_refused(tmp_path: Path, joint: str, message: str) -> None:
    folder = tmp_path / "robots" / "mine"
    folder.mkdir(parents=True)
    shipped = load_robot("lookout").urdf_path
    (folder / "lookout.urdf").write_bytes(shipped.read_bytes())
    text = shipped.with_name("robot.yaml").read_text()
    (folder / "robot.yaml").write_text(text.replace("joint: pan_joint", f"joint: {joint}"))
    with pytest.raises(RobotError, match=message):
        load_robot("mine", tmp_path)
