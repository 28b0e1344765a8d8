"""Nav2's actions and services, served by a world: real clients, a real robot in the house."""

from __future__ import annotations

import math
import os
import time
from typing import TYPE_CHECKING, Any

import pytest
from geometry_msgs.msg import Point
from nav2_msgs.action import (
    BackUp,
    ComputePathToPose,
    FollowPath,
    NavigateToPose,
    Spin,
)
from nav2_msgs.srv import ClearEntireCostmap, GetCost, IsPathValid
from nav_msgs.msg import OccupancyGrid, Path
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

from executor.navigation.forms import duration, path_message, stamped
from executor.navigation.node import ACTIONS, SERVICES, code_of
from executor.navigation.others import SETTLE_S
from tests.executor.navigation.drive import Drive, driven

if TYPE_CHECKING:
    from collections.abc import Iterator

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
HALL = stamped((-3.0, 1.2, 0.0), 0.0)
KITCHEN = stamped((4.9, -1.5, 0.0), 0.0)


@pytest.fixture
def drive() -> Iterator[Drive]:
    with driven() as made:
        yield made


def x_of(drive: Drive) -> float:
    return drive.world.robots[0].pose[0]


def test_it_is_off_until_someone_uses_it(drive: Drive) -> None:
    for _ in range(60):
        drive.turn()
    assert not drive.navigation.is_on
    assert not drive.node.count_services("/is_path_valid")
    drive.client(Spin, "/spin")
    assert drive.navigation.is_on


def test_it_is_off_where_another_node_offers_a_name(drive: Drive) -> None:
    drive.node.create_service(IsPathValid, "/is_path_valid", lambda _request, response: response)
    drive.node.create_client(IsPathValid, "/is_path_valid")
    for _ in range(60):
        drive.turn()
    assert not drive.navigation.is_on


def test_it_waits_for_a_node_that_may_offer_it(drive: Drive) -> None:
    drive.navigation.expect(["client"])
    began_s = time.monotonic()
    drive.client(Spin, "/spin")
    assert time.monotonic() - began_s >= SETTLE_S
    assert drive.navigation.is_on


def test_it_withdraws_where_another_node_offers_a_name_after_its_last_goal(drive: Drive) -> None:
    client = drive.client(Spin, "/spin")
    handle = drive.send(client, Spin.Goal(target_yaw=0.5, time_allowance=duration(10.0)))
    other = drive.node.create_service(IsPathValid, "/is_path_valid", lambda _request, response: response)
    assert drive.result(handle).status == SUCCEEDED
    drive.until(lambda: not drive.navigation.is_on)
    drive.until(lambda: drive.node.count_services("/spin/_action/send_goal") == 0)
    assert drive.node.count_services("/is_path_valid") == 1
    drive.node.destroy_service(other)
    drive.until(client.server_is_ready)
    again = drive.send(client, Spin.Goal(target_yaw=0.5, time_allowance=duration(10.0)))
    assert drive.result(again).status == SUCCEEDED


def test_it_withdraws_at_once_for_a_node_that_has_just_been_started(drive: Drive) -> None:
    client = drive.client(Spin, "/spin")
    drive.navigation.expect([])
    assert drive.navigation.is_on
    drive.navigation.expect(["navigator"])
    assert not drive.navigation.is_on
    drive.until(lambda: not client.server_is_ready())


def test_it_opens_also_while_the_world_is_paused(drive: Drive) -> None:
    maps: list[Any] = []
    drive.node.create_subscription(OccupancyGrid, "/map", maps.append, LATCHED)
    while not drive.navigation.is_on:
        drive.navigation.poll(is_paused=True)
    drive.until(lambda: maps)
    occupied = sum(cell == 100 for cell in maps[0].data) / len(maps[0].data)
    assert 0.05 < occupied < 0.5


def test_the_robot_visits_a_pose_with_feedback_a_plan_and_its_place_in_the_map(drive: Drive) -> None:
    plans: list[Path] = []
    frames: list[TFMessage] = []
    drive.node.create_subscription(Path, "/plan", plans.append, 10)
    drive.node.create_subscription(TFMessage, "/tf", frames.append, 100)
    feedback: list[Any] = []
    client = drive.client(NavigateToPose, "/navigate_to_pose")
    answer = drive.result(drive.send(client, NavigateToPose.Goal(pose=HALL), feedback))
    assert (answer.status, answer.result.error_code) == (SUCCEEDED, 0)
    assert math.dist(drive.world.robots[0].pose[:2], (-3.0, 1.2)) < 0.25
    assert drive.world.robots[0].collisions == 0
    left = [each.distance_remaining for each in feedback]
    assert left[-1] < 0.5 < max(left)
    assert plans[0].poses[-1].pose.position.x == pytest.approx(-3.0, abs=0.05)
    assert (frames[-1].transforms[0].header.frame_id, frames[-1].transforms[0].child_frame_id) == (
        "map",
        "odom",
    )
    assert frames[-1].transforms[0].transform.translation.x == pytest.approx(-4.9, abs=0.2)


def test_a_cancelled_goal_stops_the_robot(drive: Drive) -> None:
    client = drive.client(NavigateToPose, "/navigate_to_pose")
    handle = drive.send(client, NavigateToPose.Goal(pose=KITCHEN))
    drive.until(lambda: x_of(drive) > -4.5)
    handle.cancel_goal_async()
    assert drive.result(handle).status == CANCELED
    for _ in range(60):
        drive.turn()
    stopped_m = x_of(drive)
    for _ in range(60):
        drive.turn()
    assert x_of(drive) == pytest.approx(stopped_m, abs=0.01)


def test_a_new_goal_replaces_the_last_one(drive: Drive) -> None:
    client = drive.client(NavigateToPose, "/navigate_to_pose")
    first = drive.send(client, NavigateToPose.Goal(pose=KITCHEN))
    second = drive.send(client, NavigateToPose.Goal(pose=HALL))
    answer = drive.result(first)
    assert (answer.status, answer.result.error_msg) == (ABORTED, "another goal replaces this one")
    assert drive.result(second).status == SUCCEEDED
    spin = drive.client(Spin, "/spin")
    turn = Spin.Goal(target_yaw=1.57, time_allowance=duration(10.0))
    third = drive.send(client, NavigateToPose.Goal(pose=KITCHEN))
    turning = drive.send(spin, turn)
    assert drive.result(third).status == ABORTED
    assert drive.result(turning).status == SUCCEEDED


def test_a_place_has_the_cost_of_nav2(drive: Drive) -> None:
    def cost(x: float, y: float) -> float:
        request = GetCost.Request(x=x, y=y, use_footprint=True)
        return float(drive.call(GetCost, "/global_costmap/get_cost_global_costmap", request).cost)

    assert cost(-3.0, 1.2) < 253
    assert cost(-3.9, 1.9) == 254
    assert cost(500.0, 0.0) == -1


def test_a_path_is_found_checked_and_followed(drive: Drive) -> None:
    planner = drive.client(ComputePathToPose, "/compute_path_to_pose")
    found = drive.result(drive.send(planner, ComputePathToPose.Goal(goal=HALL))).result
    assert found.error_code == 0
    checked = drive.call(IsPathValid, "/is_path_valid", IsPathValid.Request(path=found.path))
    assert checked.is_valid
    through_walls = path_message([(-3.0, 1.2), (-3.9, 1.9)], None, 0.0)
    checked = drive.call(IsPathValid, "/is_path_valid", IsPathValid.Request(path=through_walls))
    assert (checked.is_valid, list(checked.invalid_pose_indices)) == (False, [1])
    assert not drive.call(IsPathValid, "/is_path_valid", IsPathValid.Request()).is_valid
    follower = drive.client(FollowPath, "/follow_path")
    assert drive.result(drive.send(follower, FollowPath.Goal(path=found.path))).status == SUCCEEDED
    assert math.dist(drive.world.robots[0].pose[:2], (-3.0, 1.2)) < 0.25


@pytest.mark.parametrize(
    ("x", "frame", "code", "words"),
    [
        (99.0, "map", 204, "outside of the map"),
        (-5.0, "map", 206, "something stands at"),
        (0.0, "mars", 202, "'mars' is not known"),
    ],
)
def test_a_goal_that_cannot_be_reached_has_the_error_code_of_nav2(
    drive: Drive, x: float, frame: str, code: int, words: str
) -> None:
    planner = drive.client(ComputePathToPose, "/compute_path_to_pose")
    goal = stamped((x, 3.35, 0.0), 0.0)
    goal.header.frame_id = frame
    answer = drive.result(drive.send(planner, ComputePathToPose.Goal(goal=goal)))
    assert (answer.status, answer.result.error_code) == (ABORTED, code)
    assert words in answer.result.error_msg


def test_the_robot_backs_up_as_far_as_there_is_room(drive: Drive) -> None:
    client = drive.client(BackUp, "/backup")
    goal = BackUp.Goal(target=Point(x=0.3), speed=0.15, time_allowance=duration(10.0))
    assert drive.result(drive.send(client, goal)).status == SUCCEEDED
    assert x_of(drive) == pytest.approx(-5.2, abs=0.08)
    goal.target.x, goal.time_allowance = 9.0, duration(100.0)
    answer = drive.result(drive.send(client, goal))
    drive.until(lambda: True)
    assert answer.status == ABORTED
    assert answer.result.error_code in {BackUp.Result.COLLISION_AHEAD, BackUp.Result.TIMEOUT}


def test_things_that_move_are_in_the_next_plan_and_costmaps_can_be_cleared(drive: Drive) -> None:
    planner = drive.client(ComputePathToPose, "/compute_path_to_pose")
    goal = ComputePathToPose.Goal(goal=HALL)
    assert drive.result(drive.send(planner, goal)).result.error_code == 0
    drive.world.move_body("sofa_seat", [-3.0, 1.2, 0.21, 0.0, 0.0, 0.0])
    name = "/global_costmap/clear_entirely_global_costmap"
    drive.call(ClearEntireCostmap, name, ClearEntireCostmap.Request())
    assert drive.result(drive.send(planner, goal)).result.error_code == 206


def test_a_reset_ends_the_goals(drive: Drive) -> None:
    client = drive.client(NavigateToPose, "/navigate_to_pose")
    handle = drive.send(client, NavigateToPose.Goal(pose=KITCHEN))
    drive.world.reset()
    drive.navigation.restart()
    answer = drive.result(handle)
    assert (answer.status, answer.result.error_msg) == (ABORTED, "the world was reset")


def test_an_action_without_codes_has_those_of_its_parts() -> None:
    assert code_of(NavigateToPose.Result, "") == 0
    assert code_of(NavigateToPose.Result, "NO_VALID_PATH") == 208
    assert code_of(NavigateToPose.Result, "FAILED_TO_MAKE_PROGRESS") == 105
    assert code_of(Spin.Result, "TIMEOUT") == 701
    assert code_of(NavigateToPose.Result, "nothing known") == 200


def test_the_names_are_those_of_nav2() -> None:
    assert "/navigate_through_poses" in ACTIONS
    assert "/local_costmap/clear_entirely_local_costmap" in SERVICES
    assert "/global_costmap/clear_around_global_costmap" in SERVICES
