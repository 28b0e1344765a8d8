"""An action client is built from blocks, without a line of Python, and drives to a goal."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(400)]

GOAL_M = 1.5
TREE = {
    "format": "bt-studio/diagram",
    "version": 1,
    "id": "MainTree",
    "root": "n1",
    "nodes": {"n1": {"type": "Sequence", "children": []}},
    "drafts": [],
    "layout": "vertical",
}
# A robot's own navigation, as another program: it accepts a goal, drives there, and reports the distance.
LAUNCH = """\
launch:
  - node: {exec: launch/navigator.py, name: navigator}
"""
NAVIGATOR = """\
import contextlib
import math

import rclpy
from geometry_msgs.msg import Twist
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer
from rclpy.executors import MultiThreadedExecutor

rclpy.init()
node = rclpy.create_node("navigator")
drive = node.create_publisher(Twist, "/cmd_vel", 10)
rate = node.create_rate(10)
place = [0.0, 0.0]


def moved(odometry):
    place[:] = odometry.pose.pose.position.x, odometry.pose.pose.position.y


def reach(handle):
    goal = handle.request.pose.pose.position
    print("the navigator drives", flush=True)
    start = list(place)
    distance = math.hypot(goal.x, goal.y)
    while distance - math.hypot(place[0] - start[0], place[1] - start[1]) > 0.02:
        left = distance - math.hypot(place[0] - start[0], place[1] - start[1])
        handle.publish_feedback(NavigateToPose.Feedback(distance_remaining=left))
        twist = Twist()
        twist.linear.x = min(0.3, left)
        drive.publish(twist)
        rate.sleep()
    drive.publish(Twist())
    handle.succeed()
    return NavigateToPose.Result()


node.create_subscription(Odometry, "/odom", moved, 10)
server = ActionServer(node, NavigateToPose, "/navigate_to_pose", reach)
executor = MultiThreadedExecutor()
executor.add_node(node)
with contextlib.suppress(KeyboardInterrupt):
    executor.spin()
"""
FILES = {
    "trees/MainTree.json": json.dumps(TREE),
    "launch/robot.launch.yaml": LAUNCH,
    "launch/navigator.py": NAVIGATOR,
}


def test_a_goal_is_sent_and_reached_without_python(studio: Studio) -> None:
    project_of_files(studio)
    the_block_is_built_from_lists(studio)
    the_robot_drives_to_the_goal(studio)


def project_of_files(studio: Studio) -> None:
    """Creates a project with these files, not through the page."""
    studio.new_from("laser_bump_and_go")
    address = f"{studio.server.origin}/api/v1/projects/{studio.page.url.rstrip('/').split('/')[-1]}"
    request = studio.page.request
    revisions = {file["path"]: file["revision"] for file in request.get(address).json()["files"]}
    files = [
        {"path": path, "content": text, "base_revision": revisions.get(path, 0)}
        for path, text in FILES.items()
    ]
    cookies = {cookie["name"]: cookie["value"] for cookie in studio.page.context.cookies()}
    answer = request.post(
        f"{address}/changes",
        data={"message": "by hand", "files": files},
        headers={"X-CSRFToken": cookies.get("csrftoken", ""), "Origin": studio.server.origin},
    )
    assert answer.ok, answer.text()
    settings = request.patch(
        address,
        data={"base_revision": request.get(address).json()["revision"], "settings": {"on_finish": "stop"}},
        headers={"X-CSRFToken": cookies.get("csrftoken", ""), "Origin": studio.server.origin},
    )
    assert settings.ok, settings.text()
    studio.page.reload()
    expect(studio.at("node-n1")).to_be_visible()


def the_block_is_built_from_lists(studio: Studio) -> None:
    page = studio.page
    studio.at("node-n1").click()
    studio.at("palette-RosAction").click()
    made = block(studio, "RosAction")
    made.click()
    studio.at("port-action_name").fill("/navigate_to_pose")
    type_ = studio.at("port-action_type")
    type_.click()
    type_.press_sequentially("navigatetop")
    page.get_by_role("option", name="nav2_msgs/action/NavigateToPose", exact=True).click()
    expect(type_).to_have_value("nav2_msgs/action/NavigateToPose")
    add_field(studio, "goal.pose.pose.position.x", "goal__pose__pose__position__x")
    studio.at("port-goal__pose__pose__position__x").fill(str(GOAL_M))
    add_field(studio, "feedback.distance_remaining", "feedback__distance_remaining")
    for timeout in ("wait_for_server_timeout", "server_timeout"):  # a busy machine is late
        studio.at(f"port-{timeout}").fill("120000")
    studio.at("port-error").fill("{why}")
    studio.saved()
    expect(made).to_contain_text("position.x")
    expect(made).not_to_have_attribute("data-problem", "error")
    studio.picture("ros-action-block")


def add_field(studio: Studio, label: str, port: str) -> None:
    """Adds a field of the interface as a port, chosen from the list."""
    studio.page.get_by_role("button", name="Add port", exact=True).click()
    studio.writing()
    studio.at("field-picker").press_sequentially(label)
    studio.page.get_by_role("option", name=label).first.click()
    expect(studio.at(f"port-{port}")).to_be_visible()


def the_robot_drives_to_the_goal(studio: Studio) -> None:
    studio.run()
    observer = studio.observe()
    wait_until(lambda: bool(observer.of("finished")), "the goal is reached", deadline_s=200)
    finished = observer.of("finished")[0]["data"]
    texts = [event["data"]["text"] for event in observer.of("log")]
    assert finished["status"] == "SUCCESS", f"{finished}; {observer.of('blackboard')[-1:]}; {texts}"
    studio.page.get_by_role("tab", name="Console", exact=True).click()
    # It was the project's own navigation, not that of the world.
    expect(studio.at("console").get_by_role("log")).to_contain_text("the navigator drives")
    _, *place = observer.track("robot")[-1]  # the robot started at the origin
    assert math.hypot(*place[:2]) == pytest.approx(GOAL_M, abs=0.15)
    studio.picture("ros-action-reached")
    observer.close()
