"""Physics truth: sensors and odometry against true values; `docs/explanation/simulation.md` has the table."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from executor.render import make_renderer
from executor.robots import load_robot, robot_ids
from executor.universes import parse_universe
from executor.world.geometry.kinematics import link_pose
from executor.world.geometry.transforms import Pose, compose, from_xyz_rpy, rotation
from executor.world.physics.bullet import BulletWorld
from executor.world.physics.drive import DifferentialDrive
from executor.world.physics.robot import ALL_GROUPS
from executor.world.sensing.lidar import LidarCaster
from executor.world.sensing.sensors import Sensors

HEAD = "format: bt-studio/universe\nversion: 1\nname: truth\n"
# A room whose inner faces are at x = 2, -3 and y = 2.5, -1.5.
ROOM = (
    HEAD
    + """\
models:
  - {id: east, shape: box, size: [0.2, 6, 1], pose: [2.1, 0.5, 0.5, 0, 0, 0]}
  - {id: west, shape: box, size: [0.2, 6, 1], pose: [-3.1, 0.5, 0.5, 0, 0, 0]}
  - {id: north, shape: box, size: [6, 0.2, 1], pose: [-0.5, 2.6, 0.5, 0, 0, 0]}
  - {id: south, shape: box, size: [6, 0.2, 1], pose: [-0.5, -1.6, 0.5, 0, 0, 0]}
robots: [{id: robot, model: MODEL, pose: [0, 0, 0, 0, 0, 0.3]}]
"""
)
WALLS = (2.0, -3.0, 2.5, -1.5)


@pytest.fixture(params=robot_ids())
def model(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def place(
    model: str, text: str = HEAD + "robots: [{id: robot, model: MODEL}]\n", **options: Any
) -> BulletWorld:
    return BulletWorld(parse_universe(text.replace("MODEL", model)), **options)


def drive(world: BulletWorld, linear: float, angular: float, seconds: float) -> None:
    for _ in range(round(seconds * 20)):
        world.robots[0].command(linear, angular)
        world.step(12)


@pytest.mark.parametrize(("part", "turn"), [(1.0, 0.0), (-0.4, 0.0), (0.0, 0.5), (0.5, 0.3), (0.6, -0.5)])
def test_each_robot_moves_as_commanded(model: str, part: float, turn: float) -> None:
    world = place(model)
    config = world.robots[0].config.drive
    linear, angular = part * config.max_linear, turn * config.max_angular
    drive(world, linear, angular, 2.0)
    before = world.robots[0].pose
    drive(world, linear, angular, 1.0)
    after, odometry = world.robots[0].pose, world.robots[0].odometry
    world.close()
    chord = abs(linear) if not angular else 2 * abs(linear / angular) * abs(math.sin(angular / 2))
    skids = len(config.left) > 1  # wheels that slide sideways turn less exactly
    assert math.dist(before[:2], after[:2]) == pytest.approx(chord, rel=0.12 if skids else 0.005, abs=0.015)
    turned = math.remainder(after[2] - before[2], 2 * math.pi)
    assert turned == pytest.approx(angular, rel=0.12 if skids else 0.005, abs=0.003)
    assert (odometry.linear, odometry.angular) == pytest.approx((linear, angular), rel=0.005, abs=0.003)


def analytic(pose: tuple[float, ...], angles: Any) -> NDArray[np.float64]:
    """Returns the distances to the walls of ROOM from a sensor's x, y and yaw."""
    x, y, yaw = pose
    east, west, north, south = WALLS
    c, s = np.cos(angles + yaw), np.sin(angles + yaw)
    with np.errstate(divide="ignore"):
        along_x = np.where(c > 0, (east - x) / c, (west - x) / c)
        along_y = np.where(s > 0, (north - y) / s, (south - y) / s)
    return np.minimum(along_x, along_y)


def test_lidar_measures_the_room(model: str) -> None:
    world = place(model, ROOM)
    world.step(120)
    robot = world.robots[0]
    lidar = robot.config.lidars[0]
    reading = robot.scan(lidar)
    world.close()
    yaw = math.atan2(2 * reading.pose[6] * reading.pose[5], 1 - 2 * reading.pose[5] ** 2)
    angles = lidar.angle_min + np.arange(lidar.rays) * lidar.angle_increment
    true = analytic((*reading.pose[:2], yaw), angles)
    seen = true < lidar.range_max - 0.1
    errors = reading.ranges[seen] - true[seen]
    assert seen.sum() > 0.9 * lidar.rays
    assert abs(errors.mean()) < 2e-3
    assert errors.std() == pytest.approx(lidar.noise_m, rel=0.15, abs=2e-3)


def quiet(model: str, text: str) -> BulletWorld:
    """Places a robot whose LIDAR and wheels have no noise, and lets it settle."""
    world = place(model, text)
    world.step(240)
    return world


def test_each_robot_stands_level(model: str) -> None:
    world = quiet(model, ROOM)
    x, y, z, w = world.robots[0].base_pose[3:]
    height = world.robots[0].base_pose[2]
    world.close()
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(2 * (w * y - z * x))
    assert abs(math.degrees(roll)) < 0.02
    assert abs(math.degrees(pitch)) < 0.02
    assert abs(height) < 1e-4


def test_lidar_without_noise_is_exact_to_a_millimetre(model: str) -> None:
    world = quiet(model, ROOM)
    robot = world.robots[0]
    lidar = robot.config.lidars[0].model_copy(update={"noise_m": 0.0})
    pose = robot.scan(lidar).pose
    ranges = LidarCaster(world._rays, lidar, robot.uid, ALL_GROUPS, (0,)).scan(world.time_s, pose).ranges
    # The pose of the sensor by the robot's drawing, not by the physics engine.
    base = from_xyz_rpy((0.0, 0.0, 0.0, 0.0, 0.0, 0.3))
    carrier, offset = robot.config.urdf.rigid_parent(lidar.link)
    assert carrier == robot.config.urdf.root
    drawn = compose(base, offset)
    world.close()
    angles = lidar.angle_min + np.arange(lidar.rays) * lidar.angle_increment
    true = analytic((*drawn[:2], 0.3), angles)
    seen = (true < lidar.range_max - 0.1) & np.isfinite(ranges)
    assert seen.sum() > 0.9 * lidar.rays
    assert np.abs(ranges[seen] - true[seen]).max() < 1e-3


def test_known_points_are_seen_at_their_designed_places(model: str) -> None:
    """By the camera at its pose on the robot, compared with the robot's drawing on level ground."""
    world = quiet(model, ROOM)
    robot = world.robots[0]
    for camera in robot.config.cameras:
        drawn = link_pose(robot.config.urdf, from_xyz_rpy((0, 0, 0, 0, 0, 0.3)), camera.link, {})
        focal = camera.width / 2 / math.tan(camera.fov / 2)
        for point in ((1.9, 0.5, 0.2), (1.9, 0.9, 0.8), (1.0, 0.3, 0.0), (1.9, 0.0, 0.5)):
            true, seen = (pixel(pose, point, focal) for pose in (drawn, robot.camera_pose(camera)))
            assert math.dist(true, seen) < 0.5
    world.close()


def pixel(camera: Pose, point: tuple[float, float, float], focal: float) -> tuple[float, float]:
    """Returns where a camera sees a point, in pixels from the middle of the picture."""
    ahead, left, up = rotation(camera[3:]).T @ (np.array(point) - np.array(camera[:3]))
    return -focal * left / ahead, -focal * up / ahead


def test_scans_of_a_seed_do_not_depend_on_subscribers(model: str) -> None:
    ranges = []
    for listens in (False, True):
        world = place(model, ROOM, seed=4)
        lidar = world.robots[0].config.lidars[0]
        for _ in range(5):
            drive(world, 0.1, 0.2, 0.2)
            if listens:
                world.robots[0].scan(lidar)
        ranges.append(world.robots[0].scan(lidar).ranges)
        world.close()
    np.testing.assert_array_equal(ranges[0], ranges[1])


def test_imu_at_rest_feels_gravity_and_nothing_else(model: str) -> None:
    world = place(model)
    world.step(240)
    robot = world.robots[0]
    imu = robot.config.imus[0]
    felt, turned = [], []
    for _ in range(100):
        world.step(8)
        reading = robot.imu(imu)
        felt.append(reading.acceleration)
        turned.append(reading.rate)
    world.close()
    assert np.linalg.norm(np.mean(felt, axis=0)) == pytest.approx(9.81, abs=0.02)
    assert np.mean(felt, axis=0)[2] == pytest.approx(9.81, abs=0.02)
    assert np.abs(np.mean(turned, axis=0)).max() < 5 * imu.rate_noise / 10
    assert np.std(felt, axis=0).max() == pytest.approx(imu.acceleration_noise, rel=0.3)


def test_imu_feels_turning_and_speeding_up() -> None:
    world = place("turtle2")
    robot = world.robots[0]
    imu = robot.config.imus[0]
    world.step(240)
    felt = []
    for _ in range(20):  # 0.4 s of acceleration
        robot.command(0.7, 0.0)
        world.step(4)
        felt.append(robot.imu(imu).acceleration[0])
    assert np.mean(felt[5:]) == pytest.approx(robot.config.drive.linear_acceleration, rel=0.05)
    drive(world, 0.0, 1.5, 2.0)
    assert robot.imu(imu).rate[2] == pytest.approx(1.5, rel=0.02)
    world.close()


def test_odometry_drifts_by_its_noise_model() -> None:
    config = load_robot("burger").drive
    way, step = 10.0, 0.04
    headings, across = [], []
    for seed in range(60):
        wheels = DifferentialDrive(config, np.random.default_rng(seed))
        wheels.observe(0.0, 0.0, 0.0)
        for i in range(1, round(way / step) + 1):
            angle = i * step / config.wheel_radius
            wheels.observe(angle, angle, step)
        headings.append(wheels.state.odometry.yaw)
        across.append(wheels.state.odometry.y)
    expected = config.slip_noise * math.sqrt(2 * way) / config.track
    assert np.std(headings) == pytest.approx(expected, rel=0.3)
    assert np.std(across) == pytest.approx(expected * way / math.sqrt(3), rel=0.35)
    assert abs(np.mean(headings)) < 3 * expected / math.sqrt(60)


def test_odometry_of_a_driven_robot_stays_within_its_noise_model(model: str) -> None:
    world = place(model, seed=2)
    config = world.robots[0].config.drive
    drive(world, config.max_linear, 0.0, 6.0)
    x, y, yaw = world.robots[0].pose
    odometry, way = world.robots[0].odometry, world.robots[0].distance_m
    world.close()
    sigma = config.slip_noise * math.sqrt(2 * way) / config.track
    assert abs(odometry.yaw - yaw) < 4 * sigma + 0.002
    assert math.hypot(odometry.x - x, odometry.y - y) < 4 * sigma * way / math.sqrt(3) + 0.002 * way


def test_a_falling_ball_keeps_its_energy_and_bounces_by_its_restitution() -> None:
    text = HEAD + "models:\n  - {id: ball, shape: sphere, size: [0.1], mass: 0.5, "
    text += "restitution: 0.8, pose: [2, 0, 2.1, 0, 0, 0]}\n"
    world = BulletWorld(parse_universe(text))
    ball = next(o.id for o in world.scene.objects if o.body == "ball")
    heights = []
    for _ in range(480):
        world.step(1)
        heights.append(float(world.poses()[ball][2]))
    world.close()
    falling = [z for z in heights[: int(0.6 * 240)] if z > 0.15]
    speeds = -np.diff(falling) * 240
    middles = (np.array(falling[1:]) + np.array(falling[:-1])) / 2
    energy = 9.81 * middles + speeds**2 / 2
    assert np.abs(energy / (9.81 * 2.1) - 1).max() < 0.01
    floor = int(np.argmin(heights[:200]))
    assert max(heights[floor:]) - 0.1 == pytest.approx(2.0 * 0.8**2, rel=0.08)
    assert min(heights) > 0.09  # and nothing sinks into the ground


@pytest.fixture
def turtle() -> Iterator[BulletWorld]:
    text = HEAD + "models: [{id: wall, shape: box, size: [0.2, 8, 4], pose: [3.1, 0, 2, 0, 0, 0]}]\n"
    world = BulletWorld(parse_universe(text))
    world.step(120)
    yield world
    world.close()


def test_depth_is_the_distance_along_the_axis(turtle: BulletWorld) -> None:
    robot = turtle.robots[0]
    camera = robot.config.cameras[0]
    sensors = Sensors(turtle, make_renderer)
    metres = sensors.depth(robot, camera)
    x, _, z, *_ = pose = robot.camera_pose(camera)
    sensors.close()
    up = 2 * math.asin(-pose[4])  # the camera looks slightly upwards
    focal = camera.width / 2 / math.tan(camera.fov / 2)
    for row in (40, 160, 240, 320):
        above = math.atan((camera.height / 2 - row - 0.5) / focal) + up
        if z + (3.0 - x) * math.tan(above) <= 0:
            continue
        expected = (3.0 - x) / math.cos(above) * math.cos(above - up)
        assert metres[row, 320] == pytest.approx(expected, abs=0.01)
    assert metres[np.isfinite(metres)].min() >= camera.depth_min
    assert metres[np.isfinite(metres)].max() <= camera.depth_max


def test_two_robots_and_a_walker_are_seen_by_the_lidar() -> None:
    text = HEAD + (
        "actors: [{id: walker, path: [[0, 2]], speed: 0}]\n"
        "robots:\n  - {id: one, model: turtle2}\n  - {id: two, model: turtle2, pose: [1.5, 0, 0, 0, 0, 0]}\n"
        "  - {id: three, model: rover, pose: [-2, 0, 0, 0, 0, 0]}\n"
    )
    world = BulletWorld(parse_universe(text))
    world.step(120)
    ranges = world.robots[0].scan(world.robots[0].config.lidars[0]).ranges
    world.close()
    assert ranges[0] == pytest.approx(1.5 - 0.038, abs=0.02)
    assert 1.7 < ranges[88:93].min() < 2.0
    assert 1.5 < ranges[170:191].min() < 2.1


def test_the_bumper_reports_which_side_was_hit() -> None:
    text = HEAD + "models: [{id: post, shape: cylinder, size: [0.05, 0.6], pose: [0.5, 0.1, 0.3, 0, 0, 0]}]\n"
    world = BulletWorld(parse_universe(text))
    world.step(60)
    assert world.robots[0].pressed() == frozenset()
    drive(world, 0.3, 0.0, 2.0)
    assert world.robots[0].pressed() <= {"left", "center"}
    assert world.robots[0].pressed()
    drive(world, -0.3, 0.0, 1.0)
    assert world.robots[0].pressed() == frozenset()
    world.close()


def test_the_battery_empties_by_use_and_an_empty_one_stops_the_wheels() -> None:
    world = place("turtle2")
    robot = world.robots[0]
    battery = robot.config.batteries[0]
    world.step(240 * 2)
    idle = battery.capacity_ah - robot.battery(battery).charge
    assert idle == pytest.approx(battery.idle_a * 2 / 3600, rel=0.02)
    drive(world, 0.7, 0.0, 2.0)
    driven = battery.capacity_ah - robot.battery(battery).charge - idle
    assert driven > 2 * idle
    assert robot.battery(battery).current < -battery.idle_a
    world.close()
