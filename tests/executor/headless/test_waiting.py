"""While an action waits in rclpy, simulated time passes."""

from __future__ import annotations

from rclpy.executors import Executor

from executor.headless.waiting import wait_in_simulation


def test_the_waits_of_rclpy_are_replaced_and_restored() -> None:
    before = Executor.spin_until_future_complete, Executor._wait_for_ready_callbacks
    restore = wait_in_simulation(lambda: 0.0, lambda: None)
    assert Executor.spin_until_future_complete is not before[0]
    restore()
    assert (Executor.spin_until_future_complete, Executor._wait_for_ready_callbacks) == before
