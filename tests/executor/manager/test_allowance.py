"""The allowance of commands of one client."""

from __future__ import annotations

import pytest

from executor.manager.allowance import COSTS, Allowance


def test_an_allowance_is_spent_and_refilled():
    allowance = Allowance(10.0, rate_hz=64.0, burst=5.0)
    assert [allowance.take("teleop", 10.0) for _ in range(5)] == [0.0] * 5
    assert allowance.take("teleop", 10.0) == 1 / 64
    assert allowance.take("teleop", 10 + 1 / 128) == 1 / 128
    assert allowance.take("teleop", 10 + 1 / 64) == 0.0
    assert allowance.take("teleop", 10 + 1 / 64) > 0
    assert [allowance.take("teleop", 99.0) for _ in range(6)][-1] > 0, "it never holds more than the burst"


def test_expensive_commands_cost_more():
    allowance = Allowance(0.0, rate_hz=10.0, burst=COSTS["list_topics"])
    assert allowance.take("list_topics", 0.0) == 0.0
    assert allowance.take("list_topics", 0.0) == pytest.approx(COSTS["list_topics"] / 10.0)


def test_driving_dragging_and_looking_at_once_are_within_the_limit():
    allowance = Allowance(0.0)
    frames = range(60 * 60)
    for n in frames:  # a minute of a page that draws 60 times a second
        sent = ["teleop", "move_body", "subscribe", *(["list_topics", "ping"] if n % 60 == 0 else [])]
        assert all(allowance.take(command, n / 60) == 0.0 for command in sent)


def test_a_page_that_reconnects_requests_everything_at_once():
    allowance = Allowance(0.0)
    wanted = ["subscribe"] * 4 + ["echo_topic"] * 24 + ["list_topics", "describe_type", "run"]
    assert all(allowance.take(command, 0.0) == 0.0 for command in wanted)


def test_a_flood_of_requests_of_the_python_debugger_passes_a_hundred_a_second():
    allowance = Allowance(0.0)
    passed = [0] * 10
    for n in range(10_000):  # a thousand a second
        passed[n // 1000] += allowance.take("dap", n / 1000) == 0.0
    assert passed[0] <= 300, "a page that begins sends its breakpoints at once"
    assert passed[2:] == [100] * 8
