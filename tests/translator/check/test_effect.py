"""Decorators that change nothing."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF, find, findings
from translator.check.effect import check_effects

WAITS = {"type": "Sleep", "ports": {"msec": "10"}}
TESTS = {"type": "ScriptCondition", "ports": {"code": "x"}}
FAILS = {"type": "AlwaysFailure"}


def over(type_, child, **ports):
    return {"n1": {"type": type_, "ports": ports, "children": ["a"]}, "a": child}


@pytest.mark.parametrize(
    ("code", "nodes"),
    [
        ("BT0119", over("ForceSuccess", LEAF)),
        ("BT0119", over("ForceFailure", FAILS)),
        ("BT0119", over("RetryUntilSuccessful", WAITS, num_attempts="3")),
        ("BT0119", over("Repeat", FAILS, num_cycles="3")),
        ("BT0119", over("KeepRunningUntilFailure", FAILS)),
        ("BT0119", over("Timeout", TESTS, msec="100")),
        ("BT0119", over("Inverter", {"type": "KeepRunningUntilFailure", "children": ["b"]}) | {"b": LEAF}),
        ("BT0123", over("Repeat", TESTS, num_cycles="1")),
        ("BT0123", over("RetryUntilSuccessful", TESTS, num_attempts="1")),
        ("BT0123", over("Timeout", WAITS, msec="0")),
        ("BT0123", over("Precondition", TESTS, **{"if": "true"})),
        ("BT0124", over("Inverter", {"type": "Inverter", "children": ["b"]}) | {"b": TESTS}),
    ],
)
def test_found(make_project, code, nodes):
    found = find(check_effects, make_project(nodes), code)
    assert found.place.node == "n1"
    assert bool(found.path) == (code == "BT0119")


@pytest.mark.parametrize(
    "nodes",
    [
        over("ForceSuccess", TESTS),
        over("Inverter", TESTS),
        over("Repeat", TESTS, num_cycles="2"),
        over("Repeat", TESTS, num_cycles="{n}"),
        over("Timeout", WAITS, msec="10"),
        over("KeepRunningUntilFailure", LEAF),
        over("RunOnce", LEAF),
        over("ForceSuccess", {"type": "Unknown"}),
        over("Precondition", TESTS, **{"if": "x"}),
        {
            **over("ForceSuccess", LEAF),
            "n1": {"type": "ForceSuccess", "children": ["a"], "conditions": {"_post": "x := 1"}},
        },
    ],
)
def test_not_found(make_project, nodes):
    assert [item.code for item in findings(check_effects, make_project(nodes))] == []
