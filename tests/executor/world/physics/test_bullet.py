import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

from executor.world.interface import WorldError

if TYPE_CHECKING:
    from executor.world.physics.bullet import BulletWorld
    from tests.executor.world.conftest import MakeWorld

SETTLE = 120

ROOM = """
models:
  - {id: wall, shape: box, size: [0.2, 4, 1], pose: [1.0, 0, 0.5, 0, 0, 0]}
  - {id: ball, shape: sphere, size: [0.1], mass: 0.2, pose: [-2, 2, 1.5, 0, 0, 0]}
"""


def drive(world: "BulletWorld", linear: float, angular: float, seconds: float) -> None:
    for _ in range(round(seconds * 20)):
        world.robots[0].command(linear, angular)
        world.step(12)


@pytest.mark.parametrize(
    ("linear", "angular"),
    [(0.3, 0.0), (0.7, 0.0), (-0.3, 0.0), (0.0, 1.0), (0.0, -2.5), (0.3, 0.5), (0.5, -1.0)],
)
def test_true_motion_is_what_was_commanded(make_world: "MakeWorld", linear: float, angular: float) -> None:
    world = make_world("empty")
    world.step(SETTLE)
    drive(world, linear, angular, 1.0)  # time to accelerate
    before, odometry_before = world.robots[0].pose, world.robots[0].odometry
    drive(world, linear, angular, 1.0)
    after, odometry = world.robots[0].pose, world.robots[0].odometry
    turned = math.remainder(after[2] - before[2], 2 * math.pi)
    assert turned == pytest.approx(angular, rel=0.02, abs=0.005)
    chord = linear if not angular else 2 * abs(linear / angular) * abs(math.sin(angular / 2))
    assert math.dist(before[:2], after[:2]) == pytest.approx(abs(chord), rel=0.02, abs=0.004)
    assert math.dist((odometry_before.x, odometry_before.y), (odometry.x, odometry.y)) == pytest.approx(
        abs(chord), rel=0.02, abs=0.004
    )
    assert odometry.angular == pytest.approx(angular, rel=0.02, abs=0.01)


def test_a_straight_line_is_straight(make_world: "MakeWorld") -> None:
    world = make_world("empty")
    drive(world, 0.5, 0.0, 8.0)
    x, y, yaw = world.robots[0].pose
    assert x > 3.5
    assert abs(y) < 0.01 * x
    assert abs(yaw) < 0.01


def test_a_robot_without_commands_stays(make_world: "MakeWorld") -> None:
    world = make_world("walled_room")
    world.step(240 * 5)
    assert world.robots[0].pose == pytest.approx((0, 0, 0), abs=2e-3)
    assert world.robots[0].distance_m < 5e-3
    assert world.robots[0].collisions == 0


def test_distance_is_that_of_the_true_path(make_world: "MakeWorld") -> None:
    world = make_world("empty")
    drive(world, 0.4, 0.8, 10.0)
    odometer = 0.4 * 10 - 0.4 * 0.4 / 2 / 1.2  # minus the loss during acceleration
    assert world.robots[0].distance_m == pytest.approx(odometer, rel=0.02)


def test_bumping_into_a_wall_is_one_collision(make_world: "MakeWorld") -> None:
    world = make_world(ROOM)
    drive(world, 0.4, 0.0, 6.0)
    robot = world.robots[0]
    assert robot.collisions == 1
    [(robot_id, collision)] = world.take_collisions()
    assert (robot_id, collision.body) == ("robot", "wall")
    assert 1.0 < collision.time_s < 3.0
    assert robot.pose[0] == pytest.approx(0.9 - 0.1765, abs=0.02)
    assert world.take_collisions() == []


def test_gravity_is_true(make_world: "MakeWorld") -> None:
    world = make_world(ROOM)
    world.step(96)
    ball = next(o.id for o in world.scene.objects if o.body == "ball")
    fallen = 1.5 - float(world.poses()[ball][2])
    assert fallen == pytest.approx(0.5 * 9.81 * 0.4**2, rel=0.02)


def test_the_same_seed_gives_the_same_world(make_world: "MakeWorld") -> None:
    text = ROOM + "random: {ball.pose.x: [-3, -1], robot.pose.yaw: [-3, 3]}\n"
    runs = []
    for seed in (1, 1, 2):
        world = make_world(text, seed=seed)
        drive(world, 0.3, 0.4, 2.0)
        runs.append((world.robots[0].pose, world.poses().tobytes()))
    assert runs[0] == runs[1]
    assert runs[0] != runs[2]


def test_reset_restores_the_initial_state(make_world: "MakeWorld") -> None:
    world = make_world("person_in_green")
    start = world.poses().copy()
    drive(world, 0.3, 0.4, 2.0)
    first = world.poses().tobytes()
    world.reset()
    assert world.time_s == 0
    np.testing.assert_allclose(world.poses(), start, atol=1e-6)
    drive(world, 0.3, 0.4, 2.0)
    assert world.poses().tobytes() == first


def test_a_saved_world_continues_exactly(make_world: "MakeWorld") -> None:
    world = make_world("person_in_green")
    drive(world, 0.3, 0.4, 2.0)
    world.step(1)  # between two control periods
    saved = world.save()
    drive(world, 0.5, -0.4, 1.5)
    expected = (world.poses().tobytes(), world.robots[0].odometry, world.robots[0].distance_m, world.time_s)
    drive(world, -0.2, 1.0, 1.0)
    world.restore(saved)
    drive(world, 0.5, -0.4, 1.5)
    again = (world.poses().tobytes(), world.robots[0].odometry, world.robots[0].distance_m, world.time_s)
    assert again == expected
    world.forget(saved)


def test_dragging_moves_without_travel(make_world: "MakeWorld") -> None:
    world = make_world(ROOM)
    world.step(SETTLE)
    distance = world.robots[0].distance_m
    world.move_body("robot", (-1, -2, 0, 0, 0, 1.5))
    world.step(SETTLE)
    assert world.robots[0].pose == pytest.approx((-1, -2, 1.5), abs=0.01)
    assert world.robots[0].distance_m == pytest.approx(distance, abs=5e-3)
    world.move_body("wall", (3, 3, 0.5, 0, 0, 0))
    wall = next(o.id for o in world.scene.objects if o.body == "wall")
    assert world.poses()[wall][:3] == pytest.approx((3, 3, 0.5))


def test_dragging_nothing_is_refused(make_world: "MakeWorld") -> None:
    with pytest.raises(WorldError, match="ghost"):
        make_world("empty").move_body("ghost", (0, 0, 0, 0, 0, 0))


def test_people_walk_and_can_be_bumped_into(make_world: "MakeWorld") -> None:
    world = make_world("actors:\n  - {id: walker, path: [[1.0, 0], [1.0, 0.2]], speed: 0.3, loop: false}\n")
    drive(world, 0.4, 0.0, 4.0)
    assert [collision.body for _, collision in world.take_collisions()] == ["walker"]
    assert world.actors[0].position[0] == 1.0


def test_the_scene_lists_everything_in_the_order_of_its_poses(make_world: "MakeWorld") -> None:
    world = make_world("person_in_green")
    scene = world.scene
    assert [o.id for o in scene.objects] == list(range(len(world.poses())))
    assert {o.kind for o in scene.objects} == {"static", "actor", "robot"}
    assert {o.link for o in scene.objects if o.kind == "robot"} == {
        "base_link",
        "wheel_left_link",
        "wheel_right_link",
    }
    assert {s.kind for s in scene.sensors} == {"lidar", "camera"}
    assert all(len(o.pose) == 7 for o in scene.objects)


def test_the_scene_shows_where_things_are_now(make_world: "MakeWorld") -> None:
    """A client that joins late must not see the robot jump from its initial pose."""
    world = make_world("empty")
    begun = {o.id: o.pose for o in world.scene.objects}
    drive(world, 0.4, 0.0, 1.0)
    scene = world.scene
    assert scene.t == pytest.approx(1.0, abs=0.01)
    assert [o.pose for o in scene.objects] == world.poses().tolist()
    base = next(o for o in scene.objects if o.link == "base_link")
    assert base.pose[0] - begun[base.id][0] > 0.1


def test_a_saved_robot_with_noisy_odometry_continues_exactly(make_world: "MakeWorld") -> None:
    world = make_world("robots: [{id: robot, model: burger}]\n", seed=3)
    drive(world, 0.2, 0.4, 1.0)
    saved = world.save()
    outcomes = []
    for _ in range(2):
        drive(world, 0.2, -0.4, 1.0)
        robot = world.robots[0]
        outcomes.append(
            (robot.odometry, robot.imu(robot.config.imus[0]), robot.battery(robot.config.batteries[0]))
        )
        world.restore(saved)
    assert outcomes[0] == outcomes[1]
    world.forget(saved)


def test_models_that_are_not_solid_are_visible_only(make_world: "MakeWorld") -> None:
    world = make_world(
        "models:\n  - {id: mist, shape: box, size: [0.2, 4, 1], pose: [1, 0, 0.5, 0, 0, 0], solid: false}\n"
    )
    assert any(o.body == "mist" for o in world.scene.objects)
    drive(world, 0.5, 0.0, 4.0)
    assert world.robots[0].pose[0] > 1.3
    assert world.robots[0].collisions == 0
    assert np.isinf(world.robots[0].scan(world.robots[0].config.lidars[0]).ranges).all()


def test_things_stand_where_they_were_dragged(make_world: "MakeWorld") -> None:
    world = make_world(ROOM)
    earlier = world.poses()
    world.move_body("wall", (3, 3, 0.5, 0, 0, 0))
    wall = next(o.id for o in world.scene.objects if o.body == "wall")
    assert earlier[wall][0] == 1.0  # callers may keep the old poses unchanged
    world.step(10)
    assert world.poses()[wall][:3] == pytest.approx((3, 3, 0.5))
    assert world.robots[0].scan(world.robots[0].config.lidars[0]).ranges[0] == np.inf
    world.reset()
    wall = next(o.id for o in world.scene.objects if o.body == "wall")
    assert world.poses()[wall][0] == 1.0


def test_noise_follows_another_seed_from_a_moment_on_but_not_its_own(make_world: "MakeWorld") -> None:
    def measured(new: int | None) -> list[bytes]:
        world = make_world("walled_room", seed=5)
        robot = world.robots[0]
        found = []
        for _ in range(2):
            drive(world, 0.2, 0.1, 0.5)
            found.append(robot.scan(robot.config.lidars[0]).ranges.tobytes())
            found.append(repr(robot.odometry).encode())
            if new is not None:
                world.reseed(new)
        return found

    plain, other = measured(None), measured(6)
    assert measured(5) == plain
    assert other[:2] == plain[:2]
    assert other[2] != plain[2]
    assert other[3] != plain[3]
    assert measured(6) == other


WALK = "actors:\n  - {{id: walker, path: [[1.0, 0], [-3.0, 0]], speed: 0.5, loop: false, yields: {yields}}}\n"


def test_a_person_who_runs_into_a_standing_robot_hits_it(make_world: "MakeWorld") -> None:
    world = make_world(WALK.format(yields="false"))
    heard: list[bool] = []
    world.on_collision = lambda _, collision: heard.append(collision.is_hit)
    drive(world, 0.0, 0.0, 3.0)
    robot = world.robots[0]
    assert (robot.collisions, robot.hits, heard) == (0, 1, [True])
    assert robot.pose[0] < -0.1  # it was pushed
    [(robot_id, collision)] = world.take_collisions()
    assert collision.told(robot_id) == "robot was hit by walker"


def test_a_robot_that_drives_into_a_person_is_not_hit(make_world: "MakeWorld") -> None:
    world = make_world("actors:\n  - {id: walker, path: [[0.7, 0]], yields: true}\n")
    drive(world, 0.4, 0.0, 3.0)
    assert (world.robots[0].collisions, world.robots[0].hits) == (1, 0)


def test_who_yields_waits_before_a_robot_and_walks_on_when_it_has_gone(make_world: "MakeWorld") -> None:
    world = make_world(WALK.format(yields="true").replace("[1.0, 0]", "[2.0, 0]"))
    drive(world, 0.0, 0.0, 5.0)
    robot, walker = world.robots[0], world.actors[0]
    waits = walker.position
    assert 0.6 < waits[0] < 1.0
    assert (robot.collisions, robot.hits) == (0, 0)
    world.move_body("robot", (0, 3, 0, 0, 0, 0))
    drive(world, 0.0, 0.0, 2.0)
    assert walker.position[0] == pytest.approx(waits[0] - 1.0, abs=0.02)


def test_hits_are_restored(make_world: "MakeWorld") -> None:
    world = make_world(WALK.format(yields="false"))
    drive(world, 0.0, 0.0, 3.0)
    saved = world.save()
    drive(world, 0.0, 1.0, 4.0)
    world.restore(saved)
    assert (world.robots[0].collisions, world.robots[0].hits) == (0, 1)
