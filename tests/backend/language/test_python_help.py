"""Help with Python over the real socket: each template and example, rclpy, messages, py_trees."""

from __future__ import annotations

import json
import re
import time
from pathlib import Path

import pytest

from backend.language.rclpy_types import RETURNED, annotated
from tests.backend.language.conftest import opened

pytestmark = pytest.mark.django_db(transaction=True)
ROOT = Path(__file__).parents[3]
TEMPLATES = sorted((ROOT / "frontend/src/features/code/templates").glob("*.py"))
EXAMPLES = sorted((ROOT / "examples").glob("*/actions/*.py"))
BEHAVIOURS = sorted((ROOT / "backend/catalog/behaviours/actions").glob("*.py"))
CAPABILITIES = {"textDocument": {"hover": {"contentFormat": ["markdown", "plaintext"]}, "diagnostic": {}}}
BUILTINS = {"print", "len", "ArithmeticError", "abs"}
HELPER = """\
from rclpy.node import Node


class Helper:
    \"\"\"Helps.\"\"\"

    def __init__(self, node: Node) -> None:
        self.node = node

    def distance(self, metres: float) -> float:
        \"\"\"Returns the distance.\"\"\"
        return metres
"""
SOURCE = """\
import py_trees
import rclpy
from geometry_msgs.msg import Twist
from nav2_msgs.action import NavigateToPose
from rclpy.action import ActionClient
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Trigger

from Helper import Helper


class Probe(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        helper = Helper(node)
        client = ActionClient(node, NavigateToPose, "/navigate_to_pose")
        twist = Twist()
        scan = LaserScan()
        goal = NavigateToPose.Goal()
        request = Trigger.Request()
        HERE
        return py_trees.common.Status.RUNNING
"""


class Document:
    """One file in the editor."""

    def __init__(self, page, uri, text):
        self.page, self.uri, self.text, self.version = page, uri, text, 1
        page.open(uri, text)

    def change(self, text):
        self.text, self.version = text, self.version + 1
        document = {"uri": self.uri, "version": self.version}
        self.page.notify("textDocument/didChange", textDocument=document, contentChanges=[{"text": text}])

    def ask(self, method, needle, offset=0, **more):
        """Sends a request about the position this many characters after the beginning of a text."""
        before = self.text[: self.text.index(needle) + offset]
        place = {"line": before.count("\n"), "character": len(before) - before.rfind("\n") - 1}
        return self.page.ask(f"textDocument/{method}", textDocument={"uri": self.uri}, position=place, **more)

    def hover(self, needle, offset=0):
        return self.ask("hover", needle, offset)["contents"]["value"]

    def offered(self, typed):
        """Returns the completions for the text that is typed at HERE."""
        before = self.text
        self.change(before.replace("HERE", typed))
        found = self.ask("completion", f"        {typed}", 8 + len(typed))
        self.change(before)
        return [each["label"] for each in found["items"]]

    def findings(self):
        """The messages of the newest findings."""
        deadline_s = time.monotonic() + 60
        while time.monotonic() < deadline_s:
            self.ask("hover", "import")  # answers come in order
            for told in reversed(self.page.told):
                found = told.get("params", {})
                if (found.get("uri"), found.get("version")) == (self.uri, self.version):
                    return [each["message"] for each in found["diagnostics"]]
        raise AssertionError("no findings came")


@pytest.fixture
def editor(host, project, api):
    files = {"actions/Helper.py": HELPER, "actions/Probe.py": SOURCE.replace("HERE", "pass")}
    rows = [{"path": path, "base_revision": 0, "content": text} for path, text in files.items()]
    api.save(project["id"], *rows)
    with opened(host, f"/ws/projects/{project['id']}/language") as page:
        page.ask("initialize", rootUri="file:///project", capabilities=CAPABILITIES)
        page.notify("initialized")
        yield lambda text, name="Probe": Document(page, f"file:///project/actions/{name}.py", text)


OFFERED = {
    "twist.linear.": {"x", "y", "z"},
    "twist.": {"linear", "angular"},
    "scan.": {"ranges", "angle_min", "header"},
    "scan.header.": {"frame_id", "stamp"},
    "goal.pose.pose.position.": {"x", "y"},
    "request.": {"__init__"},
    "py_trees.": {"behaviour", "common", "composites"},
    "py_trees.common.": {"Status", "Access"},
    "py_trees.common.Status.": {"SUCCESS", "FAILURE", "RUNNING", "INVALID"},
    "rclpy.": {"init", "node", "spin_once", "ok"},
    "node.": {"create_publisher", "create_subscription", "get_clock"},
    "node.get_logger().": {"info", "warning", "error"},
    "node.get_clock().now().": {"nanoseconds", "to_msg"},
    "client.": {"send_goal_async", "server_is_ready"},
    "client.send_goal_async(goal).": {"add_done_callback", "done", "result"},
    "helper.": {"distance", "node"},
    "helper.node.": {"create_publisher"},
    "self.": {"feedback_message", "name", "logger"},
}


def test_after_a_dot_stand_the_names_of_what_is_before_it_and_no_builtins(editor):
    document = editor(SOURCE)
    for typed, expected in OFFERED.items():
        offered = document.offered(typed)
        assert expected <= set(offered), typed
        assert not BUILTINS & set(offered), typed


def test_after_the_dot_of_something_unknown_no_builtins_are_offered(editor):
    document = editor(SOURCE)
    for typed in ("nothing.", "twist.nothing.", 'kwargs["node"].'):
        assert not BUILTINS & set(document.offered(typed)), typed


def test_hover_says_what_a_name_is(editor):
    document = editor(SOURCE.replace("HERE", "node.get_logger().info(str(helper.distance(twist.linear.x)))"))
    for needle, offset, expected in (
        ("Behaviour)", 2, "class Behaviour"),
        ("Status.RUNNING", 2, "class Status"),
        ("Twist()", 1, "geometry_msgs/msg/Twist"),
        ("linear.x", 1, "geometry_msgs/Vector3"),
        ("get_logger", 2, "RcutilsLogger"),
        ("distance(", 2, "Returns the distance."),
        ("node: Node", 7, "A Node in the ROS graph."),
    ):
        text = document.hover(needle, offset)
        assert expected in text, needle
        assert "Unknown" not in text, needle
        assert "```xml" not in text


def test_signatures_are_shown(editor):
    document = editor(SOURCE.replace("HERE", "node.create_publisher()"))
    [found] = document.ask("signatureHelp", "create_publisher(", 17)["signatures"]
    assert "topic: str" in found["label"]
    document.change(SOURCE.replace("HERE", "helper.distance()"))
    [found] = document.ask("signatureHelp", "distance(", 9)["signatures"]
    assert "metres: float" in found["label"]


def test_definitions_and_names_of_the_project_are_followed(editor):
    helper = editor(HELPER, "Helper").uri
    document = editor(SOURCE.replace("HERE", "helper.distance(1.0)"))
    assert [each["uri"] for each in document.ask("definition", "distance(", 2)] == [helper]
    edits = document.ask("rename", "distance(", 2, newName="away")
    changed = edits.get("changes") or {e["textDocument"]["uri"]: e["edits"] for e in edits["documentChanges"]}
    assert set(changed) == {document.uri, helper}
    assert {edit["newText"] for edits in changed.values() for edit in edits} == {"away"}


@pytest.mark.parametrize("paths", [TEMPLATES, EXAMPLES, BEHAVIOURS], ids=["templates", "examples", "blocks"])
def test_the_python_that_we_ship_is_understood(editor, paths):
    """No file has findings, and each import is known. One server reads all, since its start takes long."""
    for path in paths:
        is_understood(editor, path)


def is_understood(editor, path):
    text = path.read_text(encoding="utf-8")
    document = editor(text, f"{path.parents[1].name}_{path.stem}")
    assert document.findings() == [], path
    base = re.findall(r"^class \w+\((?:[\w.]*\.)?(\w+)\):", text, re.MULTILINE)[0]
    assert f"class {base}" in document.hover(f"{base})", 2), path
    for name in re.findall(r"^from \w+\.(?:msg|srv|action) import (\w+)", text, re.MULTILINE):
        assert f"class {name}" in document.hover(f"import {name}", 8), (path, name)
    status = re.findall(r"\b(?:py_trees\.common\.)?Status\.(?=[A-Z])", text)[0]
    document.change(f"{text}\n{status}\n")
    found = document.ask("completion", f"\n{status}\n", 1 + len(status))
    assert {"SUCCESS", "FAILURE", "RUNNING"} <= {each["label"] for each in found["items"]}, path


def test_mistakes_are_found(editor):
    bad = "twist.lineer = 1\n        twist.linear.x = 'fast'\n        helper.nothing()\n        undefined"
    found = editor(SOURCE.replace("HERE", bad)).findings()
    assert [
        any(name in message for message in found) for name in ("lineer", "fast", "nothing", "undefined")
    ] == [True] * 4
    assert str(ROOT) not in json.dumps(found)


def test_a_return_type_is_added_once_and_only_where_none_is():
    source = "class A:\n    def one(self, x: int = (1)):\n        return x\n\n    def two(self) -> str: ...\n"
    text = annotated(source, {"A.one": "bool", "A.two": "bool"})
    assert 'def one(self, x: int = (1)) -> "bool":\n        return x' in text
    assert "def two(self) -> str:" in text
    several = "class A:\n    def one(\n        self,\n        x=1,\n    ):\n        return x\n"
    assert ') -> "bool":\n        return x' in annotated(several, {"A.one": "bool"})


def test_the_installed_rclpy_has_all_methods_that_are_annotated():
    import rclpy

    for name, methods in RETURNED.items():
        source = (Path(rclpy.__file__).parent / name).read_text(encoding="utf-8")
        text = annotated(source, methods)
        assert text.count('-> "') - source.count('-> "') == len(methods), name
