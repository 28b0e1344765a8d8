"""Goals of Nav2's actions as tasks, with an ideal robot."""

from __future__ import annotations

import math
from typing import Any

import pytest
from geometry_msgs.msg import Point
from nav2_msgs.action import (
    BackUp,
    ComputePathThroughPoses,
    ComputePathToPose,
    DriveOnHeading,
    FollowPath,
    NavigateThroughPoses,
    NavigateToPose,
    Wait,
)
from nav2_msgs.action import Spin as SpinAction

from executor.navigation import tasks
from executor.navigation.forms import FrameError, duration, path_message, stamped
from executor.navigation.grid import Grid
from executor.navigation.planner import Map
from executor.navigation.tasks import Situation, Task

DT_S = 0.05
SPACE = Map(Grid.empty((0, 0), (6, 4), 0.05), 0.2)


def at(time_s: float = 0.0, pose: tuple[float, float, float] = (1.0, 1.0, 0.0)) -> Situation:
    return Situation(time_s, pose, pose, 0.0, lambda: SPACE)


def carried_out(task: Task, *, most_s: float = 60.0) -> Situation:
    """Works on a task with a robot that carries out every command."""
    now = at()
    while not task.state.is_over and now.now_s < most_s:
        task.step(now)
        x, y, yaw = now.pose
        yaw += task.state.angular * DT_S
        step_m = task.state.linear * DT_S
        pose = (x + step_m * math.cos(yaw), y + step_m * math.sin(yaw), yaw)
        now = Situation(now.now_s + DT_S, pose, pose, task.state.linear, lambda: SPACE)
    assert task.state.is_over
    return now


def test_a_path_to_a_pose_and_over_poses() -> None:
    task = tasks.FindPath(ComputePathToPose.Goal(goal=stamped((5.0, 3.0, 1.0), 0.0)), at())
    carried_out(task)
    result = ComputePathToPose.Result()
    task.answer(result, at(0.5))
    assert result.path.poses[-1].pose.position.x == pytest.approx(5.0, abs=0.05)
    assert (result.planning_time.sec, result.planning_time.nanosec) == (0, 500_000_000)
    assert task.plan()[1] == pytest.approx(1.0)
    over = ComputePathThroughPoses.Goal()
    poses = [stamped((2.0, 3.0, 0.0), 0.0), stamped((5.0, 3.0, 1.0), 0.0)]
    over.goals = type(over.goals)(poses) if isinstance(over.goals, list) else type(over.goals)(goals=poses)
    task = tasks.FindPath(over, at())
    carried_out(task)
    assert min(math.dist(point, (2, 3)) for point in task.plan()[0]) < 0.1


def test_no_poses_and_an_unknown_frame_are_named_as_nav2_names_them() -> None:
    assert tasks.FindPath(ComputePathThroughPoses.Goal(), at()).state.error == "NO_VIAPOINTS_GIVEN"
    goal = ComputePathToPose.Goal(goal=stamped((5.0, 3.0, 1.0), 0.0))
    goal.goal.header.frame_id = "mars"
    with pytest.raises(FrameError):
        tasks.FindPath(goal, at())


def test_a_start_may_be_given() -> None:
    goal = ComputePathToPose.Goal(goal=stamped((5.0, 3.0, 1.0), 0.0), use_start=True)
    goal.start = stamped((4.0, 3.0, 0.0), 0.0)
    task = tasks.FindPath(goal, at())
    carried_out(task)
    assert len(task.plan()[0]) < 30


def test_a_path_is_followed_and_another_one_replaces_it_without_a_stop() -> None:
    first = tasks.FollowPath(FollowPath.Goal(path=path_message([(1, 1), (2, 1), (3, 1)], 0.0, 0.0)), at())
    first.step(at())
    second = FollowPath.Goal(path=path_message([(1, 1), (2, 1), (2, 2)], 1.0, 0.0))
    task = tasks.FollowPath(second, at(1.0), first)
    now = carried_out(task)
    assert math.dist(now.pose[:2], (2, 2)) < 0.25
    assert now.pose[2] == pytest.approx(1.0, abs=0.25)
    feedback = FollowPath.Feedback()
    task.report(feedback, now)
    assert feedback.distance_to_goal < 0.3
    assert tasks.FollowPath(FollowPath.Goal(), at()).state.error == "INVALID_PATH"


def test_a_path_whose_poses_have_no_frame_is_in_the_frame_of_the_path() -> None:
    goal = FollowPath.Goal(path=path_message([(1, 0), (2, 0)], 0.0, 0.0))
    goal.path.header.frame_id = "base_link"
    for pose in goal.path.poses:
        pose.header.frame_id = ""
    now = carried_out(tasks.FollowPath(goal, at()))
    assert math.dist(now.pose[:2], (3, 1)) < 0.25


def test_poses_are_visited_in_order_and_reported() -> None:
    goal = NavigateThroughPoses.Goal()
    poses = [stamped((2.0, 3.0, 0.0), 0.0), stamped((5.0, 3.0, 0.0), 0.0)]
    goal.poses = poses if isinstance(goal.poses, list) else type(goal.poses)(goals=poses)
    task = tasks.Navigate(goal, at())
    feedback = NavigateThroughPoses.Feedback()
    task.report(feedback, at())
    assert feedback.number_of_poses_remaining == 2
    now = carried_out(task)
    task.report(feedback, now)
    assert feedback.number_of_poses_remaining == 1
    assert math.dist(now.pose[:2], (5, 3)) < 0.25
    single = tasks.Navigate(NavigateToPose.Goal(pose=stamped((3.0, 1.0, 0.0), 0.0)), at())
    assert math.dist(carried_out(single).pose[:2], (3, 1)) < 0.25
    assert single.plan()[0]


def test_motions_without_a_path() -> None:
    allowance = duration(10.0)
    now = carried_out(tasks.spin(SpinAction.Goal(target_yaw=1.5, time_allowance=allowance), at()))
    assert now.pose[2] == pytest.approx(1.5, abs=0.1)
    target = Point(x=0.3)
    task = tasks.back_up(BackUp.Goal(target=target, speed=0.1, time_allowance=allowance), at())
    now = carried_out(task)
    assert now.pose[0] == pytest.approx(0.7, abs=0.02)
    feedback = BackUp.Feedback()
    task.report(feedback, now)
    assert feedback.distance_traveled == pytest.approx(0.3, abs=0.02)
    ahead = DriveOnHeading.Goal(target=target, speed=0.2, time_allowance=allowance)
    assert carried_out(tasks.drive_on_heading(ahead, at())).pose[0] == pytest.approx(1.3, abs=0.02)


def test_a_motion_that_takes_too_long_or_meets_something_says_so() -> None:
    late = SpinAction.Goal(target_yaw=6.0, time_allowance=duration(0.2))
    task = tasks.spin(late, at())
    carried_out(task)
    assert task.state.error == "TIMEOUT"
    far = BackUp.Goal(target=Point(x=3.0), speed=0.2, time_allowance=duration(60.0))
    task = tasks.back_up(far, at())
    carried_out(task)
    assert task.state.error == "COLLISION_AHEAD"
    assert task.state.message == "something stands in the way"


@pytest.mark.parametrize(
    "goal",
    [
        {"target": Point(x=1.0, y=0.5), "speed": 0.1},
        {"target": Point(x=1.0), "speed": -0.1},
        {"target": Point(x=1.0), "speed": 0.0},
    ],
)
def test_a_drive_that_makes_no_sense_is_refused(goal: dict[str, Any]) -> None:
    assert tasks.drive_on_heading(DriveOnHeading.Goal(**goal), at()).state.error == "INVALID_INPUT"


def test_a_pause_takes_its_time() -> None:
    task = tasks.Pause(Wait.Goal(time=duration(2.0)), at())
    feedback = Wait.Feedback()
    task.report(feedback, at(0.5))
    assert (feedback.time_left.sec, feedback.time_left.nanosec) == (1, 500_000_000)
    now = carried_out(task)
    assert now.now_s == pytest.approx(2.0, abs=0.11)
    result = Wait.Result()
    task.answer(result, at(2.0))
    assert result.total_elapsed_time.sec == 2
