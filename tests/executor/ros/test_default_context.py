"""rclpy's default context belongs to the actions of one run."""

from __future__ import annotations

import rclpy
from rclpy import utilities

from executor.ros.default_context import DefaultContext


def test_it_is_open_until_it_is_closed_and_the_one_before_returns() -> None:
    before = utilities.g_default_context
    opened = DefaultContext(simulated=True)
    node = rclpy.create_node("of_a_run")
    assert node.get_parameter("use_sim_time").value is True
    assert rclpy.ok()
    node.destroy_node()
    opened.close()
    assert not opened.context.ok()
    assert utilities.g_default_context is before
