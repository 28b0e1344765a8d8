"""The editor's template of an action that sends a goal, with real action servers."""

import asyncio
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from executor.ros.environment import ros_environment
from tests.executor.application.real_application import app
from tests.executor.session_client import SessionClient, manager_process, run_data

ROOT = Path(__file__).parents[2]
TEMPLATE = ROOT / "frontend" / "src" / "features" / "code" / "templates" / "goal.py"
GOAL = TEMPLATE.read_text(encoding="utf-8").replace("NewAction", "Act")

SERVER = """
import py_trees
from nav2_msgs.action import NavigateToPose
from rclpy.action import ActionServer


class Serve(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        self.server = ActionServer(kwargs["node"], NavigateToPose, "/navigate_to_pose", self.reach)

    def reach(self, handle):
        position = handle.request.pose.pose.position
        print("reached", position.x, position.y)
        handle.succeed() if position.x >= 0 else handle.abort()
        return NavigateToPose.Result()

    def update(self):
        return py_trees.common.Status.SUCCESS
"""
RUN = """
import sys
from executor.headless.lockstep import LockstepOptions, run_lockstep
report = run_lockstep({"self_contained_tree.xml": sys.stdin.buffer.read()}, LockstepOptions(duration_s=5))
print(report.root_status, report.sim_time_s, report.errors)
"""


@pytest.mark.parametrize(("x", "status"), [("1.5", "SUCCESS"), ("-1.0", "FAILURE")])
async def test_a_goal_is_sent_to_a_server_in_another_process(x, status):
    async with manager_process() as manager:
        environment = {**os.environ, **ros_environment(manager.ready["domain_id"])}
        command = [sys.executable, str(Path(__file__).with_name("goal_server.py"))]
        with _started(command, environment) as server:
            try:
                await _send(manager, server, x, status)
            finally:
                server.kill()


def _started(command, environment):
    return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)


async def _send(manager, server, x, status):
    assert await asyncio.to_thread(server.stdout.readline) == "ready\n"
    client = await SessionClient(manager.ready["port"]).open()
    application = app(GOAL, tree=f"<Act _bts_id='n1' x='{x}' y='2.5'/>")
    assert await client.ask("connect") == "ack"
    assert await client.ask("run", run_data(application, on_finish="stop")) == "ack"
    ended = await client.event("finished")
    assert ended["data"]["status"] == status
    line = await asyncio.to_thread(server.stdout.readline)
    assert json.loads(line) == ["map", float(x), 2.5]
    await client.close()


@pytest.mark.parametrize(("x", "status"), [("1.5", "SUCCESS"), ("-1.0", "FAILURE")])
def test_in_lockstep_a_goal_is_sent_to_a_server_of_the_project(x, status):
    """Lock-step reaches no other process: an action of the project is the server. The result is equal."""
    code = "".join(
        f"<Action name='{name}'><![CDATA[{source}]]></Action>"
        for name, source in (("Act", GOAL), ("Serve", SERVER))
    )
    tree = f"<Sequence><Serve/><Act x='{x}' y='2.5'/></Sequence>"
    xml = f"<root BTCPP_format='4'><BehaviorTree ID='Main'>{tree}</BehaviorTree><Code>{code}</Code></root>"
    said = []
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", RUN],
            input=xml.encode(),
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            capture_output=True,
            timeout=200,
            check=False,
        )
        assert done.returncode == 0, done.stderr.decode()
        said.append(done.stdout.decode())
    assert said[0] == said[1]
    assert f"reached {float(x)} 2.5" in said[0]
    assert said[0].splitlines()[-1].startswith(f"{status} ")
    assert said[0].rstrip().endswith("[]"), "no fault"
