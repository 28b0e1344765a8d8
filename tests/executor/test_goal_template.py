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
from tests.executor.session_client import run_data
from tests.executor.warm import warm_session

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
GOALS = (("1.5", "SUCCESS"), ("-1.0", "FAILURE"))
RUN = """
import json
import sys
from executor.headless.lockstep import LockstepOptions, run_lockstep
for xml in json.load(sys.stdin):
    report = run_lockstep({"self_contained_tree.xml": xml.encode()}, LockstepOptions(duration_s=5))
    print(report.root_status, report.sim_time_s, report.errors)
"""


@pytest.mark.parametrize(("x", "status"), GOALS)
async def test_a_goal_is_sent_to_a_server_in_another_process(x, status):
    async with warm_session(stream=False) as (manager, client):
        environment = {**os.environ, **ros_environment(manager.ready["domain_id"])}
        command = [sys.executable, str(Path(__file__).with_name("goal_server.py"))]
        with _started(command, environment) as server:
            try:
                await _send(client, server, x, status)
            finally:
                server.kill()


def _started(command, environment):
    return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)


async def _send(client, server, x, status):
    assert await asyncio.to_thread(server.stdout.readline) == "ready\n"
    application = app(GOAL, tree=f"<Act _bts_id='n1' x='{x}' y='2.5'/>")
    assert await client.ask("run", run_data(application, on_finish="stop")) == "ack"
    ended = await client.event("finished")
    assert ended["data"]["status"] == status
    line = await asyncio.to_thread(server.stdout.readline)
    assert json.loads(line) == ["map", float(x), 2.5]


def test_in_lockstep_a_goal_is_sent_to_a_server_of_the_project():
    """Lock-step reaches no other process: an action of the project is the server. The result is equal."""
    code = "".join(
        f"<Action name='{name}'><![CDATA[{source}]]></Action>"
        for name, source in (("Act", GOAL), ("Serve", SERVER))
    )
    trees = [f"<Sequence><Serve/><Act x='{x}' y='2.5'/></Sequence>" for x, _ in GOALS]
    xmls = [
        f"<root BTCPP_format='4'><BehaviorTree ID='Main'>{tree}</BehaviorTree><Code>{code}</Code></root>"
        for tree in trees
    ]
    said = []
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", RUN],
            input=json.dumps(xmls),
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            capture_output=True,
            text=True,
            timeout=200,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        said.append(done.stdout)
    assert said[0] == said[1]
    lines = said[0].splitlines()
    ends = [line for line in lines if line.startswith(("SUCCESS ", "FAILURE "))]
    assert [line.split()[0] for line in ends] == [status for _, status in GOALS]
    assert all(line.endswith("[]") for line in ends), "no fault"
    reached = [line for line in lines if "reached" in line]
    assert len(reached) == len(GOALS)
    for (x, _), line in zip(GOALS, reached, strict=True):
        assert f"reached {float(x)} 2.5" in line
