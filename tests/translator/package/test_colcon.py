"""The packages are really built by colcon, sourced and started; another process receives their messages."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
import yaml

from tests.fakes.launch_modules import launch
from tests.translator.conftest import EXAMPLES, example_files
from tests.translator.package.patrol import LAUNCH_FILE, NAME, SPEED, patrol
from translator import load, open_path, to_app_zip, to_ros2_package

pytestmark = pytest.mark.timeout(400)

OBSERVER = Path(__file__).with_name("observer.py")

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
    """Both examples, a project with all that a package can hold, and an XML file with a folder of actions."""
    (folder / "actions").mkdir()
    (folder / "actions" / "Wave.py").write_text(WAVE)
    (folder / "actions" / "shared.py").write_text("def scaled(value):\n    return 2 * value\n")
    (folder / "wave hand.xml").write_text(XML)
    wave = open_path(folder / "wave hand.xml", actions=folder / "actions", stubs=False)
    examples = [to_ros2_package(load(example_files(name))) for name in EXAMPLES]
    return [*examples, patrol(), to_ros2_package(wave)]


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


@pytest.mark.parametrize("name", [*EXAMPLES, "wave_hand", NAME])
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
    speeds = {"wave_hand": 0.5, NAME: SPEED}
    assert (linear, angular) == (0.0, speeds[name] if name in speeds else turning_speed(name))


def turning_speed(name):
    """Returns the speed of the example's Turn: both examples turn if there are no sensors."""
    (turn,) = [node for node in load(example_files(name)).main.walk() if node.type == "Turn"]
    return float(turn.ports["ang_speed"])


def test_the_workflow_of_a_package_reports_the_behaviour_tests_that_fail(workspace):
    """Its commands are run as they stand there, but for those that install ROS."""
    name = "laser_bump_and_go"
    workflow = yaml.safe_load((workspace / "src/.github/workflows" / f"{name}.yml").read_text())
    [job] = workflow["jobs"].values()
    commands = [step["run"] for step in job["steps"] if "colcon" in step.get("run", "")]
    assert [re.search(r"colcon [\w-]+", each)[0] for each in commands] == [
        "colcon build",
        "colcon test",
        "colcon test-result",
    ]

    def tested():
        for command in commands[1:]:
            done = subprocess.run(
                ["bash", "-e", "-c", command],
                cwd=workspace,
                env=environment(workspace),
                capture_output=True,
                text=True,
                timeout=300,
                check=False,
            )
        return done

    passed = tested()
    assert passed.returncode == 0, passed.stdout + passed.stderr
    assert re.search(r"Summary: 4 tests, 0 errors, 0 failures", passed.stdout)
    [tree] = (workspace / "src" / name).rglob(f"trees/{name}.xml")
    text = tree.read_text()
    tree.write_text(text.replace("ReactiveSequence", "Sequence"))
    try:
        failed = tested()
    finally:
        tree.write_text(text)
    assert failed.returncode == 1
    assert "turns while something is near, and does not drive meanwhile" in failed.stdout


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


@pytest.fixture
def launched(workspace, monkeypatch):
    """Returns what a launch file starts with these arguments."""

    def start(name, **arguments):
        monkeypatch.setenv("AMENT_PREFIX_PATH", f"{workspace}/install/{name}")
        path = workspace / "install" / name / "share" / name / "launch" / f"{name}.launch.py"
        return launch(monkeypatch, path, arguments)

    return start


def installed_params(workspace, name):
    return str(workspace / "install" / name / "share" / name / "config" / "params.yaml")


def test_an_argument_chooses_the_program(workspace, launched):
    name = EXAMPLES[0]
    for run_as, executable in (
        ("tree", name),
        ("server", f"{name}_server"),
        ("lifecycle", f"{name}_lifecycle"),
    ):
        (process,) = launched(name, run_as=run_as).processes
        assert process.executable == executable
        assert (workspace / "install" / name / "lib" / name / executable).is_file()
    (process,) = launched(name, run_as="server", on_new_goal="queue", action_name="/run").processes
    assert process.words[:2] == ["--action_name=/run", "--on_new_goal=queue"]
    with pytest.raises(RuntimeError, match="run_as: 'demon' is not one of tree, server, lifecycle"):
        launched(name, run_as="demon")


@pytest.mark.parametrize("name", EXAMPLES)
def test_without_arguments_the_file_of_parameters_decides(workspace, launched, name):
    (process,) = launched(name).processes
    assert (process.package, process.executable, process.respawn) == (name, name, False)
    params = installed_params(workspace, name)
    assert process.words == ["--ros-args", "-r", f"__node:={name}", "--params-file", params]


def test_each_argument_that_is_given_goes_before_the_file(launched, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.yaml").touch()
    (tmp_path / "mine.xml").touch()
    parameters = {"tick_hz": "5.5", "on_finish": "repeat", "on_error": "failure", "use_sim_time": "True"}
    given = {
        **parameters,
        "tree": "mine.xml",
        "params_file": "mine.yaml",
        "namespace": "robot1/",
        "remaps": " /said:=/loud,  chatter:=say",
        "respawn": "true",
        "respawn_delay": "0.5",
    }
    (process,) = launched(NAME, **given).processes
    assert (process.respawn, process.respawn_delay) == (True, 0.5)
    own = process.words[: process.words.index("--ros-args")]
    expected = {**parameters, "tree": f"{tmp_path}/mine.xml"}
    assert set(own) == {f"--{name}={text}" for name, text in expected.items()}
    assert process.words[len(own) :] == [
        *("--ros-args", "-r", "__node:=patrol", "-r", "__ns:=/robot1"),
        *("--params-file", f"{tmp_path}/mine.yaml", "-p", "use_sim_time:=True"),
        # The user's rules, the first of which wins in ROS; then the names with a slash, into the namespace.
        *("-r", "/said:=/loud", "-r", "chatter:=say"),
        *("-r", "/chatter:=chatter", "-r", "/cmd_vel:=cmd_vel", "-r", "/said:=said"),
    ]


def test_a_launch_file_of_the_project_is_included_without_arguments_that_were_not_given(launched):
    context = launched(NAME, namespace="a", rate="9.0", use_sim_time="true")
    (included,) = context.included
    assert included.path.name == LAUNCH_FILE
    seen = included.configurations
    assert (seen["ros_namespace"], seen["rate"], seen["use_sim_time"]) == ("/a", "9.0", "true")
    assert "params_file" not in seen
    assert "tick_hz" not in seen
    assert (included.path.parent / "flow.yaml").is_file()
    assert "ros_namespace" not in context.launch_configurations


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"params_file": "none.yaml"}, "params_file: there is no file /.*/none.yaml"),
        ({"tree": "~/none.xml"}, "tree: there is no file /.*/none.xml"),
        ({"use_sim_time": "yes"}, "use_sim_time: 'yes' is neither true nor false"),
        ({"respawn": "1"}, "respawn: '1' is neither true nor false"),
        ({"respawn_delay": "soon"}, "respawn_delay: 'soon' is not a number from 0 on"),
        ({"respawn_delay": "-1"}, "respawn_delay: '-1' is not a number from 0 on"),
        ({"remaps": "/a:=/b /c"}, "remaps: '/c' is no rule; write OLD:=NEW"),
        ({"remaps": ":=/b"}, "remaps: ':=/b' is no rule"),
    ],
)
def test_a_wrong_argument_is_refused_by_name(launched, arguments, said):
    with pytest.raises(RuntimeError, match=said):
        launched(NAME, **arguments)


def test_the_node_starts_with_the_words_of_the_launch_file(workspace, launched, tmp_path):
    """Its parameters, as another process reads them, and its topics."""
    (tmp_path / "mine.yaml").write_text(
        "/**:\n  ros__parameters:\n    tick_hz: 40\n    on_error: failure\n    text: from the file\n"
    )
    given = {"namespace": "/robot1", "tick_hz": "12.5", "remaps": "/said:=/loud", "on_finish": "repeat"}
    (process,) = launched(NAME, params_file=str(tmp_path / "mine.yaml"), **given).processes
    program = [f"{workspace}/install/{NAME}/lib/{NAME}/{NAME}", *process.words]
    values = observed(workspace, program, "/robot1/patrol")
    assert values["parameters"] == {
        "tick_hz": 12.5,
        "on_finish": "repeat",
        "on_error": "failure",
        "text": "from the file",
        "use_sim_time": False,
    }
    assert values["publishes"] == ["/loud", "/robot1/cmd_vel"]
    assert values["subscribes"] == ["/ear"]


def test_programs_of_the_project_are_executables_of_the_package(workspace):
    folder = workspace / "install" / NAME / "lib" / NAME
    own = [NAME, f"{NAME}_lifecycle", f"{NAME}_server"]
    assert sorted(path.name for path in folder.iterdir()) == ["my talker.py", *own, "tools_it's.py"]
    values = observed(workspace, [str(folder / "my talker.py")], "/talker")
    assert values["publishes"] == ["/chatter"]


def observed(workspace, command, node):
    """Starts a program in the workspace and returns what another process sees of its node."""
    env = environment(workspace)
    script = f'source "{workspace}/install/setup.bash" && exec "$@"'
    program = subprocess.Popen(
        ["bash", "-c", script, "bash", *command],
        env=env,
        cwd="/",
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        seen = subprocess.run(
            [sys.executable, OBSERVER, node],
            env=env,
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
    finally:
        program.send_signal(signal.SIGINT)
        said, _ = program.communicate(timeout=60)
    assert seen.returncode == 0, seen.stderr + said
    assert program.returncode == 0, said
    return json.loads(seen.stdout)


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
