"""A wrong value in a ROS message is an error with file, line, field and remedy, in every way to run."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from executor.manager.programs import session_programs
from tests.executor.application.real_application import action, app, run_data, session
from tests.executor.headless.test_lockstep_actions import project
from tests.executor.warm import warm_session
from tree_gardener.ros_fields import VARIABLE

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(200)]

BODY = """
def update(self):
    from geometry_msgs.msg import Twist
    twist = Twist()
    twist.linear.x = 1
    return Status.RUNNING
"""
CALLBACK = """
def setup(self, **kwargs):
    kwargs["node"].create_timer(0.1, self.turn)
def turn(self):
    from geometry_msgs.msg import Vector3
    Vector3(x=1)
def update(self):
    return Status.RUNNING
"""
ROOT = Path(__file__).parents[2]
PROGRAM = str(Path(sys.executable).with_name("bt-studio"))
SENTENCE = "geometry_msgs/Vector3.x takes a float, not the int 1: write 1.0"
EXACT = {"universe": "walled_room", "time": "exact", "seed": 1}


async def fault_of(client: Any, data: dict[str, Any]) -> dict[str, Any]:
    assert await client.ask("run", data) == "ack"
    fault: dict[str, Any] = (await client.event("fault"))["data"]
    assert SENTENCE in fault["message"]
    assert SENTENCE in fault["traceback"]
    return fault


@pytest.mark.parametrize(("body", "line"), [(BODY, 9), (CALLBACK, 10)])
async def test_in_a_session(body: str, line: int) -> None:
    async with session() as client:
        fault = await fault_of(client, run_data(app(action(body))))
        assert (fault["file"], fault["line"]) == ("actions/Act.py", line)


@pytest.mark.parametrize(("body", "line"), [(BODY, 9), (CALLBACK, 10)])
async def test_in_an_exact_session(body: str, line: int) -> None:
    async with warm_session() as (_, client):
        fault = await fault_of(client, run_data(app(action(body))) | {"universe": EXACT})
        assert (fault["file"], fault["line"]) == ("actions/Act.py", line)


@pytest.mark.parametrize(("body", "line"), [(BODY, 9), (CALLBACK, 10)])
def test_in_lock_step(tmp_path: Path, body: str, line: int) -> None:
    folder = project(tmp_path / "act", "pass", **{"actions/Act.py": action(body)})
    report = tmp_path / "report.json"
    words = ["run", str(folder), "--lockstep", "--duration", "3", "--report", str(report)]
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert f"actions/Act.py:{line}" in done.stdout + done.stderr
    assert SENTENCE in json.loads(report.read_text())["errors"][0]["message"]


TEST = """format: bt-studio/test
version: 1
tests:
  - name: one tick
    doubles: {Act: real}
    ticks: 1
    expect: [{at: 1, root: SUCCESS}]
"""


def test_in_a_behaviour_test(tmp_path: Path) -> None:
    files = {"actions/Act.py": action(BODY), "tests/a.test.yaml": TEST}
    folder = project(tmp_path / "act", "pass", **files)
    done = subprocess.run([PROGRAM, "test", str(folder)], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert f"{SENTENCE} (actions/Act.py:9)" in done.stdout + done.stderr


def test_in_an_evaluation(tmp_path: Path) -> None:
    folder = shutil.copytree(ROOT / "examples/laser_bump_and_go", tmp_path / "bump")
    forward = folder / "actions/Forward.py"
    publish = "        self.publisher.publish(twist)\n"
    forward.write_text(forward.read_text().replace(publish, f"        twist.linear.x = 1\n{publish}"))
    words = ["run", str(folder), "--evaluation", "room"]
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert SENTENCE in done.stdout + done.stderr
    assert "actions/Forward.py:" in done.stdout + done.stderr


MAIN = """
import sys
from tree_gardener import ros_main
sys.exit(getattr(ros_main, sys.argv[1])(sys.argv[2], node_name="act", actions=sys.argv[3], args=[]))
"""


def test_in_an_exported_node(tmp_path: Path) -> None:
    (tmp_path / "actions").mkdir()
    (tmp_path / "actions/Act.py").write_text(action(BODY))
    tree = tmp_path / "tree.xml"
    code = '<Code><Action name="Act"/></Code>'
    tree.write_text(f'<root BTCPP_format="4"><BehaviorTree ID="T"><Act/></BehaviorTree>{code}</root>')
    environment = {**os.environ, "ROS_DOMAIN_ID": "12", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    environment.pop("ROS_PYTHON_CHECK_FIELDS", None)
    done = subprocess.run(
        [sys.executable, "-c", MAIN, "run_tree", str(tree), str(tmp_path / "actions")],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode != 0
    assert SENTENCE in done.stderr
    assert "actions/Act.py:9" in done.stderr


LOADED = """
import sys
from tree_gardener import ros_main
status = getattr(ros_main, sys.argv[1])("none.xml", node_name="act", args=["--tick_hz=no"])
from rcl_interfaces.msg import _log
print(status, _log.ros_python_check_fields)
"""


@pytest.mark.parametrize("program", ["run_tree", "serve_trees", "manage_tree"])
def test_each_exported_program_checks_from_the_first_message_on(program: str) -> None:
    environment = {key: value for key, value in os.environ.items() if key != VARIABLE}
    done = subprocess.run(
        [sys.executable, "-c", LOADED, program],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert done.stdout.split() == ["1", "1"]


def test_nodes_of_launch_files_check_their_fields() -> None:
    assert session_programs(1)["application"].environment[VARIABLE] == "1"
    assert VARIABLE not in session_programs(1)["world"].environment  # it runs no code of users
