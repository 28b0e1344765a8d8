"""A run in the hands of its user: rates, values, output, nodes, messages, lost connections, a second tab."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.server import wait_until
from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser, Locator

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

TREE = {
    "format": "bt-studio/diagram",
    "version": 1,
    "id": "MainTree",
    "root": "n1",
    "nodes": {
        "n1": {"type": "Sequence", "children": ["n2", "n3"]},
        "n2": {"type": "Script", "ports": {"code": "pace := 0.25; motto := 'steady'"}},
        "n3": {
            "type": "Work",
            "name": "worker",
            "ports": {"pace": "{pace}", "count": "{count}", "ready": "{ready}"},
        },
    },
    "drafts": [],
    "layout": "vertical",
}
WORK = """\
import sys

import py_trees

from tree_gardener.ports import Port, get_input, set_output


class Work(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"pace": Port(float, default=0.1)}
    OUTPUT_PORTS = {"count": Port(int), "ready": Port(bool)}
    count = 0

    def update(self):
        self.count += 1
        set_output(self, "count", self.count)
        if self.count == 1:
            set_output(self, "ready", True)
        if self.count % 10 == 1:
            print(f"the pace is {get_input(self, 'pace')}, see Work.py:3")
            print("take care", file=sys.stderr)
        return py_trees.common.Status.RUNNING
"""
LAUNCH = """\
launch:
  - node: {exec: launch/talker.py, name: talker}
  - node: {exec: launch/brief.py, name: brief}
"""
TALKER = """\
import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
publisher = node.create_publisher(String, "/chatter", 10)


def say():
    publisher.publish(String(data="hello"))
    print("said hello", flush=True)


node.create_timer(0.2, say)
rclpy.spin(node)
"""
BRIEF = 'print("not for long", flush=True)\nraise SystemExit(3)\n'
FILES = {
    "trees/MainTree.json": json.dumps(TREE),
    "actions/Work.py": WORK,
    "launch/extra.launch.yaml": LAUNCH,
    "launch/talker.py": TALKER,
    "launch/brief.py": BRIEF,
}


def test_a_run_is_handled(open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser) -> None:
    studio = open_studio(browser_without_webgl)
    studio.page.set_default_timeout(40_000)
    project_of_files(studio)
    choose(studio, "sim-speed", "×2")
    studio.run()
    rates_are_changed_while_it_runs(studio)
    the_blackboard_is_written(studio)
    the_console_leads_to_block_and_line(studio)
    extra_nodes_are_told_apart(studio)
    a_message_is_published(studio)
    the_world_is_reset_and_the_program_restarted(studio)
    a_lost_connection_comes_back(studio)
    a_second_tab_looks_on_and_takes_over(studio)


def project_of_files(studio: Studio) -> None:
    """A project with these files, written past the page."""
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
    studio.page.reload()
    expect(studio.at("node-n3")).to_be_visible()


def choose(studio: Studio, menu: str, name: str) -> None:
    """Chooses one of several in a menu that is marked for it."""
    studio.at(menu).click()
    studio.page.get_by_role("menuitemradio", name=name, exact=True).click()


def panel(studio: Studio, name: str) -> None:
    studio.page.get_by_role("tab", name=name, exact=True).click()


def rates_are_changed_while_it_runs(studio: Studio) -> None:
    expect(studio.at("sim-speed")).to_have_text("×2")
    choose(studio, "sim-speed", "×max")
    wait_until(lambda: studio.stat("rtf") > 2.2, "time passes as fast as the machine can")
    choose(studio, "sim-speed", "×1")
    wait_until(lambda: studio.stat("rtf") < 1.2, "time passes as it does")
    choose(studio, "tick-rate", "10 Hz")
    expect(studio.at("sim-stats")).to_contain_text("/ 100 ms")
    studio.saved()
    expect(studio.at("restart-offer")).to_have_count(0)
    choose(studio, "run-menu", "2 times a second")
    studio.at("run-menu").click()
    follow = studio.page.get_by_role("menuitemcheckbox", name="Follow the running block")
    follow.click()
    studio.at("run-menu").click()
    expect(follow).to_have_attribute("aria-checked", "true")
    follow.click()


def the_blackboard_is_written(studio: Studio) -> None:
    panel(studio, "Blackboard")
    count = value(studio, "count", 2)
    expect(count).not_to_have_text("")
    was = int(count.inner_text())
    wait_until(lambda: int(count.inner_text()) > was, "a value lives")
    studio.at("pause").click()
    studio.expect_state("paused")
    expect(value(studio, "pace", 3)).to_have_text("double")
    pace = studio.at("blackboard-pace").get_by_role("textbox")
    pace.fill("fast")
    pace.press("Enter")
    expect(studio.at("blackboard-pace")).to_contain_text("pace is a number, such as 0.5")
    expect(pace).to_have_value("fast")
    pace.fill("4")
    pace.press("Enter")
    expect(studio.at("blackboard-pace")).not_to_contain_text("such as")
    motto = studio.at("blackboard-motto").get_by_role("textbox")
    motto.fill("quick")
    motto.press("Tab")
    studio.at("blackboard-ready").get_by_role("combobox").select_option("false")
    studio.at("step").click()
    for key, kept, kind in (("motto", "quick", "string"), ("ready", "false", "bool")):
        expect(studio.at(f"blackboard-{key}").locator("input, select")).to_have_value(kept)
        expect(value(studio, key, 3)).to_have_text(kind)
    expect(studio.at("node-n3")).to_have_attribute("data-status", "RUNNING")
    studio.at("resume").click()
    expect(value(studio, "pace", 2)).to_have_text("4")
    expect(value(studio, "pace", 3)).to_have_text("double")


def value(studio: Studio, key: str, column: int) -> Locator:
    return studio.at(f"blackboard-{key}").locator(f"> :nth-child({column})")


def the_console_leads_to_block_and_line(studio: Studio) -> None:
    panel(studio, "Console")
    console, lines = studio.at("console"), studio.at("console").get_by_role("log")
    console.get_by_role("searchbox").fill("the pace is 4.0")
    expect(lines).to_contain_text("the pace is 4.0")
    expect(lines).not_to_contain_text("hello")
    console.get_by_role("button", name="Work.py:3").first.click()
    expect(studio.at("code-editor")).to_have_attribute("data-path", "actions/Work.py")
    console.get_by_role("button", name="worker").first.click()
    expect(studio.at("inspector")).to_have_attribute("aria-label", "worker")
    console.get_by_role("searchbox").fill("")
    console.get_by_role("combobox", name="Level").select_option("error")
    expect(lines).to_contain_text("take care")
    expect(lines).not_to_contain_text("the pace")
    console.get_by_role("combobox", name="Level").select_option("info")


def extra_nodes_are_told_apart(studio: Studio) -> None:
    panel(studio, "Topics")
    studio.at("topics").get_by_text("Extra nodes").click()
    brief, talker = studio.at("launch-brief"), studio.at("launch-talker")
    expect(talker).to_have_attribute("data-state", "running")
    expect(brief).to_have_attribute("data-state", "failed")
    expect(brief).to_contain_text("ended with exit code 3")
    expect(studio.at("banner")).to_contain_text("The node brief ended")
    brief.get_by_role("button", name="Restart").click()
    expect(brief).to_contain_text("restarted once")
    expect(brief).to_have_attribute("data-state", "failed")
    studio.at("banner").get_by_role("button", name="Dismiss").last.click()
    talker.get_by_role("button", name="Log").click()
    lines = studio.at("console").get_by_role("log")
    expect(lines).to_contain_text("said hello")
    expect(lines).not_to_contain_text("not for long")
    studio.picture("run-nodes")
    studio.at("console").get_by_role("combobox", name="Source").select_option("all")


def a_message_is_published(studio: Studio) -> None:
    panel(studio, "Topics")
    studio.at("topics").get_by_text("Topics", exact=True).first.click()
    studio.at("topic-/chatter").get_by_role("button").click()
    expect(studio.at("echo-/chatter")).to_contain_text('"hello"')
    studio.at("topics").get_by_role("button", name="Publish…").click()
    form = studio.at("publish")
    form.get_by_label("Topic").fill("/cmd_vel")
    form.get_by_label("Type").fill("geometry_msgs/msg/Twist")
    expect(form).to_contain_text("angular: geometry_msgs/Vector3")
    message, publish = form.get_by_label("Message"), form.get_by_role("button", name="Publish once")
    message.fill('{"linear": {"x": "far"}}')
    publish.click()
    expect(form.get_by_role("status")).to_have_text("linear.x: must be a number, not text 'far'.")
    message.fill('{"linear": ')
    publish.click()
    expect(form).to_contain_text("This is not JSON")
    expect(form.get_by_role("status")).to_have_count(0)
    message.fill('{"linear": {"x": 0.2}}')
    publish.click()
    expect(form.get_by_role("status")).to_have_text("One message was published on /cmd_vel.")
    form.get_by_role("button", name="Close").click()
    wait_until(lambda: studio.stat("distance") > 0.02, "the robot heard it")


def the_world_is_reset_and_the_program_restarted(studio: Studio) -> None:
    studio.at("run-menu").click()
    studio.page.get_by_role("menuitem", name="Reset the world").click()
    wait_until(lambda: studio.stat("distance") < 0.01, "the robot is back")
    panel(studio, "MainTree")
    panel(studio, "Inspector")
    studio.set_port("n3", "pace", "7")
    studio.at("restart-offer").get_by_role("button", name="Restart").click()
    expect(studio.at("restart-offer")).to_have_count(0)
    panel(studio, "Console")
    expect(studio.at("console").get_by_role("log")).to_contain_text("the pace is 7.0")
    studio.expect_state("application_running")


def a_lost_connection_comes_back(studio: Studio) -> None:
    context = studio.page.context
    context.set_offline(True)
    expect(studio.at("banner")).to_contain_text("The server cannot be reached.")
    expect(studio.at("executor-state")).to_have_attribute("data-shown", "lost")
    studio.at("pause").click()
    context.set_offline(False)
    # What the program's new start had to say, and neither the connection nor the key that came to nothing.
    expect(studio.at("banner")).to_contain_text("The node brief ended")
    studio.expect_state("application_running")
    studio.page.reload()
    studio.expect_state("application_running")
    expect(studio.at("console")).to_contain_text("the pace is 7.0")
    before = studio.stat("t")
    wait_until(lambda: studio.stat("t") > before, "time goes on for this page")


def a_second_tab_looks_on_and_takes_over(studio: Studio) -> None:
    second = Studio(studio.page.context.new_page(), studio.server)
    second.page.goto(studio.page.url)
    second.expect_state("application_running")
    expect(second.at("run")).to_have_attribute("aria-disabled", "true")
    expect(second.at("pause")).to_be_disabled()
    expect(second.at("sim-speed")).to_be_disabled()
    second.at("run").hover()
    expect(second.page.get_by_role("tooltip")).to_contain_text(re.compile("somebody else drives"))
    studio.page.close()
    expect(second.at("run")).to_have_attribute("aria-disabled", "false")
    second.at("pause").click()
    second.expect_state("paused")
    second.end_session()
    assert second.complaints == []
