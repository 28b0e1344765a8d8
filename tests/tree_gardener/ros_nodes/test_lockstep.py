"""ROS nodes in lock-step: a goal and a service call in simulated time, twice with the same result."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[3]

SERVER = """
import py_trees
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from std_srvs.srv import SetBool


class Serve(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        node = kwargs["node"]
        self.action = ActionServer(node, Fibonacci, "/fib", self.reach)
        self.service = node.create_service(SetBool, "/light", self.answer)

    def reach(self, handle):
        handle.succeed()
        return Fibonacci.Result(sequence=range(handle.request.order))

    def answer(self, request, response):
        response.success = request.data
        return response

    def update(self):
        return py_trees.common.Status.SUCCESS
"""
TREE = (
    "<Sequence><Serve/>"
    "<RosAction action_name='/fib' action_type='example_interfaces/action/Fibonacci' goal__order='3'/>"
    "<RosService service_name='/light' service_type='std_srvs/srv/SetBool' request__data='true'/>"
    "<RosSubscribe topic_name='/scan' topic_type='sensor_msgs/msg/LaserScan' mode='wait'/>"
    "<TfLookup target_frame='odom' source_frame='base_footprint'/>"
    "<Fallback><RosAction action_name='/nobody' action_type='example_interfaces/action/Fibonacci'/>"
    "<AlwaysSuccess/></Fallback></Sequence>"
)
RUN = """
import sys
from executor.headless.lockstep import LockstepOptions, run_lockstep
report = run_lockstep({"self_contained_tree.xml": sys.stdin.buffer.read()}, LockstepOptions(duration_s=5))
print(report.root_status, report.sim_time_s, report.ticks, report.errors)
"""


def test_a_run_in_lockstep_is_repeatable() -> None:
    code = f"<Code><Action name='Serve'><![CDATA[{SERVER}]]></Action></Code>"
    xml = f"<root BTCPP_format='4'><BehaviorTree ID='Main'>{TREE}</BehaviorTree>{code}</root>"
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
    status, time_s, _, errors = said[0].split(maxsplit=3)
    assert (status, errors.strip()) == ("SUCCESS", "[]")
    assert 0.5 < float(time_s) < 2.0, "the missing server costs half a second of simulated time"
