"""Jobs with an ideal robot on a small map: arrival, refusals with Nav2's names, and recovery."""

from __future__ import annotations

import math

import pytest

from executor.navigation.grid import Grid
from executor.navigation.jobs import Following, Navigating, Planning, State
from executor.navigation.planner import Map

Pose = tuple[float, float, float]
DT_S = 0.05


def room(*, with_wall: bool = False, door: bool = True) -> Map:
    """A free floor of 6 by 4 m; with a wall in the middle that has a door."""
    grid = Grid.empty((0, 0), (6, 4), 0.05)
    if with_wall:
        grid.occupied[:, 60] = True
        if door:
            grid.occupied[50:72, 60] = False
    grid.occupied[0, :] = grid.occupied[-1, :] = True
    return Map(grid, 0.2)


def planned(space: Map, start: Pose, *goals: Pose) -> Planning:
    planning = Planning(space, start, goals)
    while not planning.step(50).is_over:
        pass
    return planning


def moved(pose: Pose, state: State) -> Pose:
    x, y, yaw = pose
    yaw += state.angular * DT_S
    return x + state.linear * DT_S * math.cos(yaw), y + state.linear * DT_S * math.sin(yaw), yaw


@pytest.mark.parametrize(
    ("start", "goal", "error"),
    [
        ((1, 1, 0), (5, 1, 0), ""),
        ((-1, 1, 0), (5, 1, 0), "START_OUTSIDE_MAP"),
        ((1, 1, 0), (9, 1, 0), "GOAL_OUTSIDE_MAP"),
    ],
)
def test_a_path_or_why_there_is_none(start: Pose, goal: Pose, error: str) -> None:
    assert planned(room(), start, goal).state.error == error


def test_a_closed_wall_leaves_no_path_and_no_goal_neither() -> None:
    found = planned(room(with_wall=True, door=False), (1, 1, 0), (5, 1, 0))
    assert found.state.error == "NO_VALID_PATH"
    assert "(5.00, 1.00)" in found.state.message
    assert planned(room(), (1, 1, 0)).state.error == "NO_VALID_PATH"


def test_an_occupied_goal_is_refused() -> None:
    grid = Grid.empty((0, 0), (6, 4), 0.05)
    grid.occupied[:, 60:] = True
    assert planned(Map(grid, 0.2), (1, 1, 0), (5, 2, 0)).state.error == "GOAL_OCCUPIED"


def test_a_path_visits_the_poses_between() -> None:
    points = planned(room(), (1, 1, 0), (3, 3, 0), (5, 1, 0)).points
    assert min(math.dist(point, (3, 3)) for point in points) < 0.1
    assert math.dist(points[-1], (5, 1)) < 0.1


def test_a_path_is_followed_and_the_heading_reached() -> None:
    space, pose, speed = room(with_wall=True), (1.0, 1.0, 2.0), 0.0
    following = Following(planned(space, pose, (5, 1, 0)).points, -1.0, 0.0, pose)
    for tick in range(2000):
        state = following.step(tick * DT_S, pose, speed, space)
        if state.is_over:
            break
        pose, speed = moved(pose, state), state.linear
        assert space.allows(pose[0], pose[1])
    assert following.state.error == ""
    assert math.dist(pose[:2], (5, 1)) < 0.25
    assert math.cos(pose[2] + 1.0) > 0.97


def test_what_stands_in_the_way_stops_the_robot_and_then_ends_the_job() -> None:
    pose = (2.4, 2.9, 0.0)
    following = Following([(2.4 + i * 0.05, 2.9) for i in range(40)], None, 0.0, pose)
    closed = room(with_wall=True, door=False)
    assert following.step(0.0, pose, 0.0, closed).linear == 0
    assert not following.state.is_over
    assert following.step(2.5, pose, 0.0, closed).error == "NO_VALID_CONTROL"


def test_a_robot_that_is_stuck_ends_the_job() -> None:
    pose = (1.0, 1.0, 0.0)
    following = Following([(1 + i * 0.05, 1.0) for i in range(40)], None, 0.0, pose)
    assert following.step(5.0, pose, 0.0, room()).linear > 0
    assert following.step(10.1, pose, 0.0, room()).error == "FAILED_TO_MAKE_PROGRESS"
    assert Following([], None, 0.0, pose).state.error == "INVALID_PATH"


def go(navigating: Navigating, pose: Pose, seconds: float) -> Pose:
    speed = 0.0
    for tick in range(round(seconds / DT_S)):
        state = navigating.step(tick * DT_S, pose, speed, 1000)
        if state.is_over:
            break
        pose, speed = moved(pose, state), state.linear
    return pose


def test_it_goes_through_the_door() -> None:
    space = room(with_wall=True)
    navigating = Navigating(lambda: space, [(5.0, 1.0, 0.0)], 0.0)
    pose = go(navigating, (1.0, 1.0, 0.0), 120)
    assert navigating.state == State(is_over=True)
    assert math.dist(pose[:2], (5, 1)) < 0.25
    assert navigating.recoveries == 0


def test_it_recovers_when_the_way_opens_again() -> None:
    spaces = {"now": room(with_wall=True, door=False)}
    navigating = Navigating(lambda: spaces["now"], [(5.0, 1.0, 0.0)], 0.0)
    pose = go(navigating, (1.0, 1.0, 0.0), 2)
    assert navigating.recoveries == 1
    spaces["now"] = room(with_wall=True)
    pose = go(navigating, pose, 120)
    assert navigating.state == State(is_over=True)
    assert math.dist(pose[:2], (5, 1)) < 0.25


def test_it_gives_up_with_the_reason() -> None:
    closed = room(with_wall=True, door=False)
    navigating = Navigating(lambda: closed, [(5.0, 1.0, 0.0)], 0.0)
    go(navigating, (1.0, 1.0, 0.0), 200)
    assert navigating.state.error == "NO_VALID_PATH"
    assert navigating.recoveries == 6
