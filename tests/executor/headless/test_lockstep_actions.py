"""Actions that use rclpy and Python in lock-step behave as in a session, or cause a fault with a reason."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import psutil
import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).parents[3]

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(200)]

HEAD = """import sys
import threading
import time

import py_trees
import rclpy
from geometry_msgs.msg import Twist
from py_trees.common import Status
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String


class Act(py_trees.behaviour.Behaviour):
"""


def project(folder: Path, body: str, **files: str) -> Path:
    lines = "".join(f"    {line}\n" if line else "\n" for line in body.strip("\n").split("\n"))
    made = {
        "project.json": json.dumps({"name": "act", "main_tree": "Main", "universe": "walled_room"}),
        "trees/Main.json": json.dumps(
            {
                "format": "bt-studio/diagram",
                "version": 1,
                "id": "Main",
                "root": "n1",
                "nodes": {"n1": {"type": "Act", "children": []}},
            }
        ),
        "actions/Act.py": HEAD + lines,
    }
    for name, text in (made | files).items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def run(folder: Path, duration_s: float = 3) -> tuple[int, dict[str, Any], str]:
    """Runs a project in the process that runs all of these: each must leave it clean for the next."""
    return RUNNER.run(folder, duration_s)


class Runner:
    """A process that runs one project after another."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None

    def run(self, folder: Path, duration_s: float) -> tuple[int, dict[str, Any], str]:
        """Returns exit status, report and all output."""
        if self._process is None:
            command = [sys.executable, str(Path(__file__).with_name("lockstep_runs.py"))]
            environment = {**os.environ, "PYTHONPATH": str(ROOT)}
            self._process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
            )
        process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(json.dumps([str(folder), duration_s]) + "\n")
        process.stdin.flush()
        answer = json.loads(process.stdout.readline())
        assert "Traceback" not in answer["said"]
        return answer["status"], answer["report"], answer["said"]

    def children(self) -> list[psutil.Process]:
        """Returns the processes that it has left."""
        assert self._process is not None
        found = psutil.Process(self._process.pid).children(recursive=True)
        return [each for each in found if each.status() != psutil.STATUS_ZOMBIE]

    def end(self) -> None:
        """Ends the process; it must have outlived all runs."""
        if self._process is not None:
            with self._process as process:
                assert process.poll() is None
                assert process.stdin is not None
                process.stdin.close()
                assert process.wait(60) == 0
        self._process = None


RUNNER = Runner()


@pytest.fixture(scope="module", autouse=True)
def _runner() -> Iterator[None]:
    yield
    RUNNER.end()


SPEAK = """
def setup(self, **kwargs):
    self.node = kwargs["node"]
    self.count = 0
"""


@pytest.mark.parametrize(
    ("body", "line"),
    [
        (SPEAK + "def update(self):\n    sys.exit(0)\n", 18),
        ("def setup(self, **kwargs):\n    sys.exit(0)\ndef update(self):\n    return Status.RUNNING\n", 15),
        (
            "def setup(self, **kwargs):\n"
            '    self.ear = kwargs["node"].create_subscription(LaserScan, "/scan", self.hear, 10)\n'
            "def hear(self, scan):\n    sys.exit(0)\n"
            "def update(self):\n    return Status.RUNNING\n",
            17,
        ),
    ],
)
def test_sys_exit_is_a_fault_of_the_node(tmp_path: Path, body: str, line: int) -> None:
    status, _, said = run(project(tmp_path, body))
    assert status == 1
    assert f"actions/Act.py:{line}:1: " in said
    assert "the action called sys.exit(0)" in said


def test_sys_exit_at_import_is_a_fault_of_the_action(tmp_path: Path) -> None:
    folder = project(tmp_path, "def update(self):\n    return Status.RUNNING\n")
    source = folder / "actions" / "Act.py"
    source.write_text("import sys\nsys.exit(0)\n" + source.read_text())
    status, _, said = run(folder)
    assert status == 1
    assert "actions/Act.py:2:" in said
    assert "sys.exit(0)" in said


def test_an_exception_in_a_callback_is_a_fault_of_the_node(tmp_path: Path) -> None:
    body = """
def setup(self, **kwargs):
    self.ear = kwargs["node"].create_subscription(LaserScan, "/scan", self.hear, 10)
def hear(self, scan):
    raise ValueError("a bad scan")
def update(self):
    return Status.RUNNING
"""
    status, report, said = run(project(tmp_path, body))
    assert status == 1
    assert "ValueError: a bad scan" in said
    [error] = report["errors"]
    assert (error["file"], error["line"]) == ("actions/Act.py", 17)
    assert error["node_path"].startswith("Act")


def test_rclpy_works_as_in_tutorials(tmp_path: Path) -> None:
    body = """
def setup(self, **kwargs):
    rclpy.init()
    self.node = kwargs["node"]
    self.scans, self.words, self.turns = [], [], 0
    self.node.create_subscription(LaserScan, "/scan", self.scans.append, 10)
    rclpy.spin_once(self.node)
    self.other = rclpy.create_node("other")
    self.other.create_subscription(String, "/words", self.words.append, 10)
    self.speaker = self.node.create_publisher(String, "/words", 10)
    self.thread = threading.Thread(target=self.turn, daemon=True)
    self.thread.start()
def turn(self):
    while rclpy.ok():
        self.turns += 1
        time.sleep(0.001)
def update(self):
    self.speaker.publish(String(data="hello"))
    rclpy.spin_once(self.other, timeout_sec=0.5)
    before = len(self.scans)
    while len(self.scans) == before:
        rclpy.spin_once(self.node, timeout_sec=1.0)
    now = self.other.get_clock().now().nanoseconds
    future = rclpy.task.Future()
    rclpy.spin_until_future_complete(self.node, future, timeout_sec=0.25)
    print("heard", len(self.words), len(self.scans) > before, rclpy.ok(), future.done(), now >= 0)
    return Status.SUCCESS if self.turns else Status.RUNNING
"""
    status, report, said = run(project(tmp_path, body), duration_s=5)
    assert status == 0, said
    assert report["root_status"] == "SUCCESS"
    assert "heard 1 True True False True" in said
    # Simulated time passed while the action waited, as real time would.
    assert 0.25 <= report["sim_time_s"] < 3


def test_waiting_in_an_action_is_the_same_each_time(tmp_path: Path) -> None:
    body = """
def setup(self, **kwargs):
    self.node, self.stamps = kwargs["node"], []
    self.node.create_subscription(LaserScan, "/scan", self.hear, 10)
    self.publisher = self.node.create_publisher(Twist, "/cmd_vel", 10)
def hear(self, scan):
    self.stamps.append(scan.header.stamp.nanosec)
def update(self):
    speed = Twist()
    speed.linear.x = 0.3
    self.publisher.publish(speed)
    rclpy.spin_once(self.node, timeout_sec=0.3)
    print(self.stamps[-1:])
    return Status.RUNNING
"""
    folder = project(tmp_path, body)
    one, two = run(folder, 4), run(folder, 4)
    assert one[1]["trajectory"] == two[1]["trajectory"]
    lines = [[line for line in said.splitlines() if line.startswith("[")] for _, _, said in (one, two)]
    assert lines[0] == lines[1]


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        ("rclpy.shutdown()", "rclpy.shutdown() would end ROS for the whole tree"),
        ("rclpy.try_shutdown()", "rclpy.shutdown() would end ROS for the whole tree"),
        ("self.node.destroy_node()", "node.destroy_node() would take the node from the whole tree"),
    ],
)
def test_shutting_ros_down_is_a_fault(tmp_path: Path, call: str, sentence: str) -> None:
    status, report, said = run(project(tmp_path, SPEAK + f"def update(self):\n    {call}\n"))
    assert status == 1
    assert sentence in said
    assert report["errors"][0]["line"] == 18


def test_waiting_without_end_ends_with_the_run(tmp_path: Path) -> None:
    body = SPEAK + "def update(self):\n    rclpy.spin(self.node)\n"
    status, report, said = run(project(tmp_path, body))
    assert status == 1
    assert "waited in rclpy until the end of the run" in said
    assert report["errors"][0]["line"] == 18


STARTS = {
    "a fork": "if os.fork() == 0:\n        time.sleep(600)",
    "a process of multiprocessing": "multiprocessing.Process(target=time.sleep, args=(600,)).start()",
    "a pool": "self.pool = concurrent.futures.ProcessPoolExecutor(2)\n    self.pool.submit(time.sleep, 600)",
    "a command": "subprocess.Popen(['sleep', '600'])",
    "one that its parent leaves": "subprocess.run('sleep 600 >/dev/null &', shell=True)",
}


@pytest.mark.parametrize("start", STARTS.values(), ids=STARTS)
def test_processes_of_an_action_end_with_the_run_and_do_not_delay_its_end(tmp_path: Path, start: str) -> None:
    body = f"""
def setup(self, **kwargs):
    import concurrent.futures, multiprocessing, os, subprocess
    {start}
def update(self):
    return Status.SUCCESS
"""
    status, report, said = run(project(tmp_path, body))
    assert (status, report["root_status"], report["errors"]) == (0, "SUCCESS", [])
    assert "timeout" not in said
    assert RUNNER.children() == []


def test_modules_and_files_of_the_project_are_found(tmp_path: Path) -> None:
    body = """
def update(self):
    import helper
    print("speed", helper.SPEED, open("assets/note.txt").read())
    return Status.SUCCESS
"""
    folder = project(tmp_path, body, **{"actions/helper.py": "SPEED = 7\n", "assets/note.txt": "found"})
    status, _, said = run(folder, 1)
    assert status == 0, said
    assert "speed 7 found" in said


def test_mismatched_ends_of_a_topic_are_reported_once(tmp_path: Path) -> None:
    body = """
def setup(self, **kwargs):
    node = kwargs["node"]
    qos = rclpy.qos.QoSProfile(depth=1, durability=rclpy.qos.DurabilityPolicy.TRANSIENT_LOCAL)
    self.ear = node.create_subscription(LaserScan, "/scan", print, qos)
def update(self):
    return Status.RUNNING
"""
    status, _, said = run(project(tmp_path, body), 12)
    assert status == 0
    assert said.count("/scan: Nothing arrives: /world keeps nothing for late subscribers") == 1


@pytest.mark.parametrize(("make", "line"), [("create_subscription", 15), ("create_publisher", 15)])
def test_another_type_of_a_topic_is_named(tmp_path: Path, make: str, line: int) -> None:
    more = "callback=print, qos_profile=10" if make == "create_subscription" else "qos_profile=10"
    body = f"""
def setup(self, **kwargs):
    self.end = kwargs["node"].{make}(String, topic="/odom", {more})
def update(self):
    return Status.RUNNING
"""
    status, _, said = run(project(tmp_path, body))
    assert status == 1
    assert f"actions/Act.py:{line}:1: " in said
    assert "/odom is of the type nav_msgs/msg/Odometry, not std_msgs/msg/String" in said


OWN = """from tree_gardener import ControlNode, DecoratorNode, Status


class Own(ControlNode):
    MARKS_RUNNING = True

    def setup(self, **kwargs):
        self.node = kwargs["node"]
        self.ticks = 0

    def update(self):
        self.ticks += 1
        print("own", self.ticks, self.node is not None, self.now() >= 0)
        return %s
"""
UNDER = json.dumps(
    {
        "format": "bt-studio/diagram",
        "version": 1,
        "id": "Main",
        "root": "n1",
        "nodes": {"n1": {"type": "Own", "children": ["n2"]}, "n2": {"type": "Act"}},
    }
)


@pytest.mark.parametrize(
    ("result", "status", "text"),
    [
        ("self.tick_child(0)", 0, "own 3 True True"),
        ("self.tick_child(1)", 1, "actions/Own.py:14:1: "),
        ("None", 1, "Own.update() returned nothing"),
    ],
)
def test_an_own_control_node_runs_or_is_named_with_its_line(
    tmp_path: Path, result: str, status: int, text: str
) -> None:
    body = """
def initialise(self):
    self.left = 2
def update(self):
    self.left -= 1
    return Status.SUCCESS if self.left < 0 else Status.RUNNING
"""
    files = {"actions/Own.py": OWN % result, "trees/Main.json": UNDER}
    found, _, said = run(project(tmp_path, body, **files))
    assert (found, text in said) == (status, True), said
