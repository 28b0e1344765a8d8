"""A package is built by colcon and started by the real `launch`; its nodes are looked at over ROS."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from tests.fakes.launch_modules import launch
from tests.ros_launch.conftest import EXAMPLE, of_launch
from tests.translator.package.patrol import NAME
from tests.translator.package.test_colcon import OBSERVER, environment

pytestmark = pytest.mark.timeout(600)

DRIVER = Path(__file__).with_name("drive.py")


class Launch:
    """A launch in progress, with all that it says."""

    def __init__(self, workspace, name, *arguments):
        self.workspace = workspace
        self.said = ""
        path = workspace / "install" / name / "share" / name / "launch" / f"{name}.launch.py"
        script = f'source "{workspace}/install/setup.bash" && exec "$@"'
        self.program = subprocess.Popen(
            ["bash", "-c", script, "bash", sys.executable, "-u", str(DRIVER), str(path), *arguments],
            env=of_launch(workspace),
            cwd=workspace,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self.reader = threading.Thread(target=self.read)
        self.reader.start()

    def read(self):
        for line in self.program.stdout:
            self.said += line

    def wait_for(self, pattern, count=1):
        """Waits until the launch has said something so often, and returns all that it said of that."""
        end_s = time.monotonic() + 90
        while len(found := re.findall(pattern, self.said)) < count:
            assert time.monotonic() < end_s, self.said
            time.sleep(0.05)
        return found

    def pids(self, count=1):
        """The processes of the tree's node so far."""
        return [
            int(pid) for pid in self.wait_for(rf"\[{NAME}-\d+\]: process started with pid \[(\d+)\]", count)
        ]

    def observed(self, node):
        """What another process sees of a node."""
        command = [sys.executable, str(OBSERVER), node]
        seen = subprocess.run(
            command, env=environment(self.workspace), capture_output=True, text=True, check=False
        )
        assert seen.returncode == 0, seen.stderr + self.said
        return json.loads(seen.stdout)

    def end(self):
        if self.program.poll() is None:
            self.program.send_signal(signal.SIGINT)
        status = self.program.wait(60)
        self.reader.join()
        self.program.stdout.close()
        return status


@pytest.fixture
def start(workspace):
    """Starts launches, and ends them after the test."""
    started = []

    def begin(name, *arguments):
        started.append(Launch(workspace, name, *arguments))
        return started[-1]

    yield begin
    for item in started:
        item.end()


def test_parameters_namespace_and_remaps_reach_all_nodes(start, workspace):
    (workspace / "mine.yaml").write_text(
        "/robot1/patrol:\n  ros__parameters: {tick_hz: 40, on_finish: repeat}\n"
        "/**:\n  ros__parameters: {on_error: failure, text: from the file}\n"
        "/robot1/talker:\n  ros__parameters: {text: to the talker}\n"
    )
    run = start(
        *(NAME, "params_file:=mine.yaml", "namespace:=robot1/", "tick_hz:=12.5", "on_error:=stop"),
        *("remaps:=/said:=/loud", "use_sim_time:=true", "rate:=3.0"),
    )
    tree = run.observed("/robot1/patrol")
    assert tree["parameters"] == {
        "tick_hz": 12.5,
        "on_finish": "repeat",
        "on_error": "stop",
        "use_sim_time": True,
        "text": "from the file",
    }
    assert tree["publishes"] == ["/loud", "/robot1/cmd_vel"]
    talker = run.observed("/robot1/talker")
    assert talker["parameters"] == {"rate": 3.0, "text": "to the talker", "use_sim_time": True}
    assert talker["publishes"] == ["/robot1/chatter"]
    flow = run.observed("/robot1/inner/flow")
    assert flow["parameters"] == {"rate": 8.0, "text": "from the file", "use_sim_time": True}
    assert run.end() == 0


def test_without_arguments_the_file_of_the_package_decides(start, workspace):
    params = workspace / "install" / NAME / "share" / NAME / "config" / "params.yaml"
    text = params.read_text()
    params.write_text(
        text.replace("tick_hz: 20.0", "tick_hz: 7").replace("on_finish: stop", "on_finish: repeat")
    )
    try:
        seen = start(NAME).observed("/patrol")["parameters"]
    finally:
        params.write_text(text)
    assert (seen["tick_hz"], seen["on_finish"], seen["use_sim_time"]) == (7, "repeat", False)


def test_the_node_comes_back_after_a_kill_where_that_was_asked_for(start):
    run = start(NAME, "respawn:=true", "respawn_delay:=0.2")
    (first,) = run.pids()
    run.observed("/patrol")
    os.kill(first, signal.SIGKILL)
    assert run.pids(2)[1] != first
    assert run.observed("/patrol")["publishes"] == ["/cmd_vel", "/said"]
    assert run.end() == 0


def test_two_packages_run_in_two_namespaces(start):
    one, two = start(NAME, "namespace:=one"), start(EXAMPLE, "namespace:=/fleet/two")
    assert one.observed("/one/patrol")["publishes"] == ["/one/cmd_vel", "/one/said"]
    seen = two.observed(f"/fleet/two/{EXAMPLE}")
    assert (seen["publishes"], seen["subscribes"]) == (["/fleet/two/cmd_vel"], ["/fleet/two/scan"])


@pytest.mark.parametrize(
    ("argument", "said"),
    [
        ("params_file:=none.yaml", "params_file: there is no file"),
        ("use_sim_time:=yes", "use_sim_time: 'yes' is neither true nor false"),
        ("remaps:=/a", "remaps: '/a' is no rule"),
        ("namespace:=1st", "The resulting namespace is invalid"),
    ],
)
def test_a_wrong_argument_ends_the_launch_with_one_sentence(start, argument, said):
    run = start(NAME, argument)
    assert run.program.wait(60) == 1
    run.reader.join()
    assert said in run.said
    assert "Traceback" not in run.said


@pytest.mark.parametrize(
    "arguments",
    [
        {},
        {"namespace": "a", "tick_hz": "5"},
        {
            "namespace": "/a/b/",
            "remaps": "/said:=/x chatter:=y",
            "use_sim_time": "true",
            "on_error": "failure",
        },
    ],
)
def test_the_stand_in_of_launch_gives_the_same_command_line(start, workspace, monkeypatch, arguments):
    run = start(EXAMPLE, *(f"{name}:={text}" for name, text in arguments.items()))
    run.wait_for("process started")
    pid = int(run.wait_for(r"process started with pid \[(\d+)\]")[0])
    words = Path(f"/proc/{pid}/cmdline").read_text().rstrip("\0").split("\0")
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{workspace}/install/{EXAMPLE}")
    path = workspace / "install" / EXAMPLE / "share" / EXAMPLE / "launch" / f"{EXAMPLE}.launch.py"
    (process,) = launch(monkeypatch, path, arguments).processes
    assert words[-len(process.words) :] == process.words
    assert words[-len(process.words) - 1].endswith(f"/lib/{EXAMPLE}/{EXAMPLE}")
