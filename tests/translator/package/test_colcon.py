"""The packages are really built by colcon, sourced and started; another process hears what they publish."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.fakes import launch_modules
from tests.translator.conftest import EXAMPLES, example_files
from translator import load, open_path, to_app_zip, to_ros2_package

pytestmark = pytest.mark.timeout(400)

LISTENER = """
import sys, time
import rclpy
from geometry_msgs.msg import Twist

rclpy.init()
node = rclpy.create_node("listener")
received = []
node.create_subscription(Twist, "/cmd_vel", received.append, 10)
print("ready", flush=True)
end = time.monotonic() + 60
while not received and time.monotonic() < end:
    rclpy.spin_once(node, timeout_sec=0.2)
print(received[0].linear.x, received[0].angular.z) if received else sys.exit("nothing came")
"""
XML = """<root BTCPP_format="4"><BehaviorTree ID="Only"><Repeat num_cycles="-1"><Wave speed="0.25"/></Repeat>
</BehaviorTree></root>"""
WAVE = """
import py_trees
from geometry_msgs.msg import Twist

from shared import scaled


class Wave(py_trees.behaviour.Behaviour):
    def __init__(self, name, ports=None):
        super().__init__(name)
        self.ports = ports

    def setup(self, **kwargs):
        self.publisher = kwargs["node"].create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        twist = Twist()
        twist.angular.z = scaled(float(self.ports["speed"]))
        self.publisher.publish(twist)
        return py_trees.common.Status.SUCCESS
"""


def packages(folder):
    """Both examples, and an XML file with a folder of actions, as packages."""
    (folder / "actions").mkdir()
    (folder / "actions" / "Wave.py").write_text(WAVE)
    (folder / "actions" / "shared.py").write_text("def scaled(value):\n    return 2 * value\n")
    (folder / "wave hand.xml").write_text(XML)
    wave = open_path(folder / "wave hand.xml", actions=folder / "actions", stubs=False)
    return [*(to_ros2_package(load(example_files(name))) for name in EXAMPLES), to_ros2_package(wave)]


@pytest.fixture(scope="module")
def workspace(tmp_path_factory):
    """A workspace with all packages, built."""
    folder = tmp_path_factory.mktemp("workspace")
    (folder / "given").mkdir()
    for package in packages(folder / "given"):
        (folder / "package.zip").write_bytes(package.to_zip())
        with zipfile.ZipFile(folder / "package.zip") as archive:
            archive.extractall(folder / "src")
    done = subprocess.run(
        ["colcon", "--log-base", "log", "build"],
        cwd=folder,
        env=environment(folder),
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def environment(folder):
    """A clean environment: nothing of this repository but its interpreter and the ROS 2 wheels."""
    kept = {
        key: value for key, value in os.environ.items() if key not in {"PYTHONPATH", "COVERAGE_PROCESS_START"}
    }
    return {
        **kept,
        "HOME": str(folder),
        "COLCON_HOME": str(folder),
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "AMENT_PREFIX_PATH": sys.prefix,
        "ROS_DOMAIN_ID": str(20 + os.getpid() % 60),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_LOG_DIR": str(folder / "ros_log"),
        "PYTHONDONTWRITEBYTECODE": "1",
    }


@pytest.mark.parametrize("name", [*EXAMPLES, "wave_hand"])
def test_the_installed_program_publishes(workspace, name):
    env = environment(workspace)
    listener = subprocess.Popen(
        [sys.executable, "-c", LISTENER], env=env, cwd=workspace, stdout=subprocess.PIPE, text=True
    )
    assert listener.stdout.readline() == "ready\n"
    script = f'source "{workspace}/install/setup.bash" && exec "$(ros_executable)"'
    script = script.replace("$(ros_executable)", f"{workspace}/install/{name}/lib/{name}/{name}")
    program = subprocess.Popen(
        ["bash", "-c", script], env=env, cwd="/", stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        heard, _ = listener.communicate(timeout=90)
        assert listener.returncode == 0
    finally:
        listener.kill()
        program.send_signal(signal.SIGINT)
        out, errors = program.communicate(timeout=30)
    assert program.returncode == 0, out + errors
    linear, angular = map(float, heard.split())
    assert (linear, angular) == (0.0, 0.5 if name == "wave_hand" else turning_speed(name))


def turning_speed(name):
    """What the example's Turn is told: without sensors, both examples turn."""
    (turn,) = [node for node in load(example_files(name)).main.walk() if node.type == "Turn"]
    return float(turn.ports["ang_speed"])


def test_an_older_engine_is_refused_by_name(workspace):
    program = f"{workspace}/install/wave_hand/lib/wave_hand/wave_hand"
    script = f'source "{workspace}/install/setup.bash" && exec "{program}"'
    main = next((workspace / "install/wave_hand").rglob("main.py"))
    text = main.read_text()
    main.write_text(text.replace("ENGINE_VERSION = '", "ENGINE_VERSION = '9"))
    try:
        done = subprocess.run(
            ["bash", "-c", script],
            env=environment(workspace),
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
    finally:
        main.write_text(text)
    assert done.returncode == 1
    assert "needs tree_gardener 90.1.0 or newer" in done.stderr


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_launch_file_describes_the_node(workspace, name, monkeypatch):
    launch_modules.install(monkeypatch)
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{workspace}/install/{name}")
    path = workspace / "install" / name / "share" / name / "launch" / f"{name}.launch.py"
    space = {}
    exec(compile(path.read_text(), str(path), "exec"), space)  # noqa: S102 - as `launch` does
    *arguments, node = space["generate_launch_description"]().values["entities"]
    assert [item.values["name"] for item in arguments] == ["tick_hz", "tree", "use_sim_time"]
    assert Path(arguments[1].values["default_value"]).is_file()
    assert node.values["package"] == node.values["executable"] == node.values["name"] == name
    params, values = node.values["parameters"]
    assert Path(params).is_file()
    assert set(values) == {"tick_hz", "tree", "use_sim_time"}


def test_the_app_for_the_manager_runs_by_itself(tmp_path):
    (tmp_path / "app.zip").write_bytes(to_app_zip(load(example_files(EXAMPLES[0]))))
    with zipfile.ZipFile(tmp_path / "app.zip") as archive:
        archive.extractall(tmp_path / "app")
    program = subprocess.Popen(
        [sys.executable, "-u", "execute_docker.py"],
        cwd=tmp_path / "app",
        env=environment(tmp_path),
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert program.stdout.readline() == "Turning\n"
    finally:
        program.send_signal(signal.SIGINT)
        program.communicate(timeout=30)
    assert program.returncode == 0
