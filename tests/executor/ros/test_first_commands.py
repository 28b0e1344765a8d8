"""The first commands of an action move the robot at the simulated time at which they are sent."""

from __future__ import annotations

import pytest

from tests.executor.application.real_application import app, run_data
from tests.executor.warm import warm_session

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(120)]

SPEED = 0.2
TICKS = 30
DRIVE = """
import py_trees
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry


class Act(py_trees.behaviour.Behaviour):
    x = count = 0

    def setup(self, **kwargs):
        self.node = kwargs["node"]
        self.node.create_subscription(Odometry, "/odom", self.see, 10)
        if not {late}:
            self.publisher = self.node.create_publisher(TwistStamped, "/cmd_vel", 10)

    def see(self, odometry):
        self.x = odometry.pose.pose.position.x

    def update(self):
        self.count += 1
        command, now = TwistStamped(), self.node.get_clock().now()
        command.header.stamp = now.to_msg()
        if self.count == 1 and {late}:
            self.publisher = self.node.create_publisher(TwistStamped, "/cmd_vel", 10)
        if self.count == 1 + {late}:  # a tick that makes a publisher takes a while itself
            self.start = now
        if self.count <= {ticks}:
            command.twist.linear.x = {speed}
        elif self.count == {ticks} + 1:
            self.duration_s = (now - self.start).nanoseconds * 1e-9
        if self.count <= {sent} or self.count > {ticks}:
            self.publisher.publish(command)
        if self.count < {ticks} + 10:
            return py_trees.common.Status.RUNNING
        print("drove", self.x, self.duration_s)
        return py_trees.common.Status.SUCCESS
"""


async def drive(*, late: bool, sent: int) -> tuple[float, float]:
    """Returns the distance in m that the robot drove, and the simulated seconds until its stop."""
    async with warm_session() as (_, client):
        source = DRIVE.format(late=late, sent=sent, ticks=TICKS, speed=SPEED)
        assert await client.ask("run", run_data(app(source)) | {"universe": {"universe": "empty"}}) == "ack"
        said = await client.event("log", lambda data: data["text"].startswith("drove"))
        x, duration_s = map(float, said["data"]["text"].split()[1:])
    return x, duration_s


@pytest.mark.parametrize("late", [False, True], ids=["made in setup", "made in a tick"])
async def test_stamped_commands_count_from_the_first_one(late: bool) -> None:
    distance_m, duration_s = await drive(late=late, sent=TICKS)
    # Speeding up and slowing down make up for each other; a command may come with one of the next looks.
    assert distance_m >= SPEED * (duration_s - 0.1)


async def test_a_command_that_is_published_once_arrives() -> None:
    distance_m, _ = await drive(late=False, sent=1)
    assert distance_m > SPEED * 0.4, "a command holds for 0.6 s"
