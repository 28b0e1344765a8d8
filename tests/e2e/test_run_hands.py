"""A run and its controls, in a browser without WebGL.

Start and cancel, rates, values, output, nodes, messages, lost connections, a second browser that takes over.
"""

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
        "n1": {"type": "Sequence", "children": ["n2", "n4", "n3"]},
        "n2": {"type": "Script", "ports": {"code": "pace := 0.25; motto := 'steady'"}},
        "n3": {
            "type": "Work",
            "name": "worker",
            "ports": {"pace": "{pace}", "count": "{count}", "ready": "{ready}"},
        },
        "n4": {"type": "SubTree", "tree": "Side", "name": "aside"},
    },
    "drafts": [],
    "layout": "vertical",
}
SIDE = TREE | {
    "id": "Side",
    "root": "s1",
    "nodes": {"s1": {"type": "Script", "ports": {"code": "inner := 5"}}},
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
            print("take \\x1b[1;31mcare\\x1b[0m", file=sys.stderr)
        return py_trees.common.Status.RUNNING
"""
LAUNCH = """\
launch:
  - node: {exec: launch/talker.py, name: talker}
  - node: {exec: nodes/brief.py, name: brief}
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
TICK_OF_20_HZ = re.compile(r"[\d.]+ / 50 ms.*×[\d.]+.* s")
BRIEF = 'print("not for long", flush=True)\nraise SystemExit(3)\n'
FILES = {
    "trees/MainTree.json": json.dumps(TREE),
    "trees/Side.json": json.dumps(SIDE),
    "actions/Work.py": WORK,
    "launch/extra.launch.yaml": LAUNCH,
    "launch/talker.py": TALKER,
    "nodes/brief.py": BRIEF,
}


def test_a_run_is_handled(open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser) -> None:
    studio = open_studio(browser_without_webgl)
    project_of_files(studio)
    a_universe_is_made_without_a_view(studio)
    studio.choose("sim-speed", "×2")
    a_start_is_reported_and_cancelled(studio)
    rates_are_changed_while_it_runs(studio)
    the_blackboard_is_written(studio)
    the_console_leads_to_block_and_line(studio)
    launch_nodes_are_distinguished(studio)
    a_message_is_published(studio)
    the_world_is_reset_and_the_program_restarted(studio)
    a_lost_connection_comes_back(studio)
    a_second_browser_views_and_takes_over(studio)


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
    studio.page.reload()
    expect(studio.at("node-n3")).to_be_visible()


def panel(studio: Studio, name: str) -> None:
    studio.page.get_by_role("tab", name=name, exact=True).click()


def a_universe_is_made_without_a_view(studio: Studio) -> None:
    """A sentence replaces the 3D view; palette, list, fields and text work all the same."""
    panel(studio, "3D")
    expect(studio.at("viewer-3d")).to_contain_text("has no WebGL: the Video view shows the same world")
    panel(studio, "Video")
    studio.at("new-universe").click()
    studio.at("choice-empty").click()
    studio.at("new-universe-name").fill("yard")
    studio.at("new-universe-ok").click()
    expect(studio.at("universe-view").get_by_role("note")).to_contain_text("change their numbers")
    studio.at("place-crate").click()
    field = studio.at("thing-fields").get_by_test_id("field-x")
    field.fill("3")
    field.press("Enter")
    text = studio.at("code-editor").locator(".cm-content")
    expect(text).to_contain_text("pose: [3, 0, 0.2, 0, 0, 0]")
    text.click()
    studio.page.keyboard.press("Control+End")
    studio.page.keyboard.insert_text("actors:\n  - {id: ann, model: person, path: [[4, 3], [6, 3]]}\n")
    expect(studio.at("thing-ann")).to_be_visible()
    studio.picture("universe-without-webgl")
    studio.saved()
    panel(studio, "MainTree")


def a_start_is_reported_and_cancelled(studio: Studio) -> None:
    """The bar names each rung; *Cancel* ends the start, without an error."""
    bar, cancel = studio.at("run-progress"), studio.at("run-progress").get_by_role("button", name="Cancel")
    studio.page.evaluate(
        """() => {
          window.told = new Set();
          new MutationObserver(() => {
            const name = document.querySelector('[data-testid=run-progress] p')?.textContent;
            if (name) window.told.add(name);
          }).observe(document.body, { subtree: true, childList: true, characterData: true });
        }"""
    )
    studio.at("run").click()
    cancel.click()
    expect(bar).to_have_count(0)
    # The distance by then depends on the machine.
    expect(studio.at("executor-state")).not_to_have_attribute("data-state", "application_running")
    expect(studio.at("banner").filter(has_text="cancelled")).to_have_count(0)
    studio.run()
    told = set(studio.page.evaluate("[...window.told]"))
    assert {"Checking the project", "Starting the session", "Starting the world"} <= told
    expect(studio.page.locator("[data-connection=open]")).to_have_text("Connected")


def rates_are_changed_while_it_runs(studio: Studio) -> None:
    expect(studio.at("sim-speed")).to_have_text("×2")
    studio.choose("sim-speed", "×max")
    wait_until(lambda: studio.stat("rtf") > 2.2, "time passes as fast as the machine can")
    studio.choose("sim-speed", "×1")
    wait_until(lambda: studio.stat("rtf") < 1.2, "time passes as it does")
    expect(studio.at("sim-stats")).to_have_text(TICK_OF_20_HZ)
    studio.choose("tick-rate", "10 Hz")
    expect(studio.at("sim-stats")).to_contain_text("/ 100 ms")
    studio.saved()
    expect(studio.at("restart-offer")).to_have_count(0)
    studio.choose("run-menu", "2 times a second")
    the_view_follows_the_running_block(studio)


def the_view_follows_the_running_block(studio: Studio) -> None:
    """Also after the user had moved the view."""
    block = studio.at("node-n3")
    studio.at("canvas").hover()
    wait_until(lambda: scrolled_away(studio, block), "the block is out of sight")
    studio.at("run-menu").click()
    follow = studio.page.get_by_role("menuitemcheckbox", name="Follow the running block")
    follow.click()
    expect(block).to_be_in_viewport()
    studio.at("run-menu").click()
    expect(follow).to_have_attribute("aria-checked", "true")
    follow.click()


def scrolled_away(studio: Studio, block: Locator) -> bool:
    """Scrolls the canvas once; returns whether no block is visible any more."""
    studio.page.mouse.wheel(0, 600)
    view, box = studio.at("canvas").bounding_box(), block.bounding_box()
    return box is None or view is None or box["y"] + box["height"] < view["y"]


def the_blackboard_is_written(studio: Studio) -> None:
    panel(studio, "Blackboard")
    count = value(studio, "count", 2)
    expect(count).not_to_have_text("")
    was = int(count.inner_text())
    wait_until(lambda: int(count.inner_text()) > was, "a value lives")
    wait_until(lambda: flashes(studio, "count") and not flashes(studio, "motto"), "what changes flashes")
    scope = studio.at("blackboard").get_by_role("table", name="aside")
    expect(scope.get_by_test_id("blackboard-inner")).to_contain_text("5")
    studio.at("pause").click()
    studio.expect_state("paused")
    the_servers_view_is_turned(studio)
    expect(value(studio, "pace", 3)).to_have_text("number")
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
        expect(value(studio, key, 3)).to_have_attribute("title", kind)
    expect(studio.at("node-n3")).to_have_attribute("data-status", "RUNNING")
    studio.at("resume").click()
    expect(value(studio, "pace", 2)).to_have_text("4")
    expect(value(studio, "pace", 3)).to_have_text("number")


def flashes(studio: Studio, key: str) -> bool:
    """Returns whether a value of the blackboard is highlighted."""
    lights = "row => row.querySelector('td span').getAnimations().length > 0"
    return bool(studio.at(f"blackboard-{key}").evaluate(lights))


def the_servers_view_is_turned(studio: Studio) -> None:
    """By dragging, scrolling and keys: the picture of a paused world changes."""
    panel(studio, "Video")
    view, mouse = studio.at("viewer-video"), studio.page.mouse
    box = view.bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drawn() -> str:
        return str(view.locator("canvas").evaluate("canvas => canvas.toDataURL()"))

    def turn() -> None:
        mouse.move(x, y)
        mouse.down()
        mouse.move(x + 80, y + 20, steps=4)
        mouse.up()

    for gesture in (turn, lambda: mouse.wheel(0, -400), lambda: view.press("ArrowLeft")):
        before = drawn()
        gesture()
        wait_until(lambda: drawn() != before, "the picture is another one")  # noqa: B023 - called at once
    expect(studio.at("view-figures")).to_have_text(re.compile(r"^\d{3,4} × \d+"))


def value(studio: Studio, key: str, column: int) -> Locator:
    return studio.at(f"blackboard-{key}").locator(f"> :nth-child({column})")


def the_console_leads_to_block_and_line(studio: Studio) -> None:
    panel(studio, "Console")
    console, lines = studio.at("console"), studio.at("console").get_by_role("log")
    console.get_by_role("searchbox").fill("the pace is 4.0")
    expect(lines).to_contain_text("the pace is 4.0")
    expect(lines).not_to_contain_text("hello")
    console.get_by_role("button", name="Work.py:3").first.click()
    code = studio.page.locator("[data-testid=code-editor]:visible")
    expect(code).to_have_attribute("data-path", "actions/Work.py")
    console.get_by_role("button", name="worker").first.click()
    expect(studio.at("inspector")).to_have_attribute("aria-label", "worker")
    console.get_by_role("searchbox").click()  # as a user's pointer would: the hovered canvas loses it
    console.get_by_role("searchbox").fill("")
    console.get_by_role("combobox", name="Level").select_option("error")
    expect(lines).to_contain_text("take care")
    expect(lines.locator("[data-ansi='bold red']").first).to_have_text("care")
    expect(lines).not_to_contain_text("the pace")
    console.get_by_role("combobox", name="Level").select_option("info")


def launch_nodes_are_distinguished(studio: Studio) -> None:
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
    drives_by_hand(studio)


def drives_by_hand(studio: Studio) -> None:
    """By a command and a key, beside the server's picture."""
    studio.at("run-menu").click()
    studio.page.get_by_role("menuitem", name="Drive the robot by hand").click()
    before = studio.stat("distance")
    studio.page.keyboard.down("ArrowDown")
    wait_until(lambda: studio.stat("distance") > before + 0.1, "the robot drives")
    studio.page.keyboard.up("ArrowDown")
    wait_until(lambda: studio.stat("speed") < 0.02, "the robot stands")
    pad = studio.at("teleop")
    turn = pad.get_by_role("button", name="Turn left")
    turn.hover()
    studio.page.mouse.down()
    expect(turn).to_have_attribute("data-held", "true")
    studio.page.mouse.up()
    expect(turn).not_to_have_attribute("data-held", "true")
    pad.get_by_role("button", name="Stop driving by hand").click()
    expect(studio.at("teleop")).to_have_count(0)


def the_world_is_reset_and_the_program_restarted(studio: Studio) -> None:
    studio.at("run-menu").click()
    studio.page.get_by_role("menuitem", name="Reset the world").click()
    wait_until(lambda: studio.stat("distance") < 0.01, "the robot is back")
    panel(studio, "MainTree")
    panel(studio, "Inspector")
    studio.set_port("n3", "pace", "7")
    before = studio.stat("t")
    # The program took the new value, so nothing asks for a restart.
    studio.at("restart").click()
    # The key waits for the new start; the lines of the old one have the new value, too.
    expect(studio.at("restart")).to_be_enabled()
    expect(studio.at("restart-offer")).to_have_count(0)
    panel(studio, "Console")
    expect(studio.at("console").get_by_role("log")).to_contain_text("the pace is 7.0")
    studio.expect_state("application_running")
    assert studio.stat("t") > before, "the world continued"


def a_lost_connection_comes_back(studio: Studio) -> None:
    context = studio.page.context
    context.set_offline(True)
    expect(studio.at("banner")).to_contain_text("The server cannot be reached.")
    expect(studio.at("executor-state")).to_have_attribute("data-shown", "lost")
    studio.at("pause").click()
    # It sent its id: the manager may not have noticed the loss yet.
    with studio.page.expect_websocket(lambda socket: "/control?client=" in socket.url):
        context.set_offline(False)
    # The output of the program's new start, and neither the connection nor the key without effect.
    expect(studio.at("banner")).to_contain_text("The node brief ended")
    studio.expect_state("application_running")
    studio.page.reload()
    studio.expect_state("application_running")
    expect(studio.at("console")).to_contain_text("the pace is 7.0")
    before = studio.stat("t")
    wait_until(lambda: studio.stat("t") > before, "time continues for this page")
    # On a busy machine the end of the old page is noticed after the start of the new one.
    expect(studio.at("run")).to_have_attribute("aria-disabled", "false")


def a_second_browser_views_and_takes_over(studio: Studio) -> None:
    browser = studio.page.context.browser
    assert browser is not None
    second = Studio(browser.new_context().new_page(), studio.server)
    second.open()
    second.page.goto(studio.page.url)
    second.expect_state("application_running")
    expect(second.at("run")).to_have_attribute("aria-disabled", "true")
    expect(second.at("pause")).to_be_disabled()
    expect(second.at("sim-speed")).to_be_disabled()
    second.at("run").hover()
    expect(second.page.get_by_role("tooltip")).to_contain_text("another window controls")
    second.at("looking-on").get_by_role("button", name="Take over").click()
    expect(second.at("looking-on")).to_have_count(0)
    second.at("pause").click()
    second.expect_state("paused")

    expect(studio.at("looking-on")).to_contain_text("Another window has taken over")
    expect(studio.at("run")).to_have_attribute("aria-disabled", "true")
    studio.expect_state("paused")
    studio.picture("taken-over")
    studio.at("looking-on").get_by_role("button", name="Take it back").click()
    expect(second.at("looking-on")).to_contain_text("Another window has taken over")
    studio.at("resume").click()
    second.expect_state("application_running")

    studio.page.close()  # the former driver does not return
    expect(second.at("looking-on")).to_have_count(0)
    expect(second.at("run")).to_have_attribute("aria-disabled", "false")
    second.end_session()
    assert second.complaints == []
    second.page.context.close()
