"""Children that can never be ticked."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF, find, findings, is_found_at_its_place
from translator.check.reach import check_reachability

CASES = {
    "unreachable in a fallback": (
        "BT0118",
        {"n1": {"type": "Fallback", "children": ["a", "b"]}, "a": LEAF, "b": LEAF},
        "a",
    ),
    "unreachable after the second of a fallback": (
        "BT0114",
        {
            "n1": {"type": "Fallback", "children": ["c", "a", "b"]},
            "a": LEAF,
            "b": LEAF,
            "c": {"type": "ScriptCondition", "ports": {"code": "x"}},
        },
        "b",
    ),
    "repeated zero times": (
        "BT0117",
        {"n1": {"type": "Repeat", "ports": {"num_cycles": "0"}, "children": ["a"]}, "a": LEAF},
        "a",
    ),
    "tried less than once": (
        "BT0117",
        {
            "n1": {"type": "RetryUntilSuccessful", "ports": {"num_attempts": "-2"}, "children": ["a"]},
            "a": LEAF,
        },
        "a",
    ),
    "a precondition that is never true": (
        "BT0117",
        {"n1": {"type": "Precondition", "ports": {"if": " false "}, "children": ["a"]}, "a": LEAF},
        "a",
    ),
    "a parallel that has enough with none": (
        "BT0117",
        {
            "n1": {"type": "Parallel", "ports": {"success_count": "0"}, "children": ["a", "b"]},
            "a": LEAF,
            "b": LEAF,
        },
        "b",
    ),
    "always skipped": (
        "BT0117",
        {"n1": {"type": "Sequence", "children": ["a"]}, "a": {**LEAF, "conditions": {"_skipIf": "true"}}},
        "a",
    ),
    "nothing to catch": (
        "BT0114",
        {"n1": {"type": "TryCatch", "children": ["a", "b"]}, "a": LEAF, "b": LEAF},
        "b",
    ),
    "unreachable in a sequence": (
        "BT0114",
        {
            "n1": {"type": "Sequence", "children": ["a", "b"]},
            "a": {"type": "Inverter", "children": ["c"]},
            "c": LEAF,
            "b": LEAF,
        },
        "b",
    ),
    "else is unreachable": (
        "BT0114",
        {"n1": {"type": "IfThenElse", "children": ["a", "b", "c"]}, "a": LEAF, "b": LEAF, "c": LEAF},
        "c",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_finding_and_its_place(make_project, name):
    is_found_at_its_place(check_reachability, make_project, CASES[name])


def test_skippable_child_lets_the_next_be_reached(make_project):
    skipped = {**LEAF, "conditions": {"_skipIf": "true"}}
    nodes = {"n1": {"type": "Fallback", "children": ["a", "b"]}, "a": skipped, "b": LEAF}
    assert "BT0114" not in [item.code for item in findings(check_reachability, make_project(nodes))]


def test_the_reason_leads_through_called_trees(make_project):
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b"]},
        "a": {"type": "SubTree", "tree": "Other"},
        "b": LEAF,
    }
    other = {"n1": {"type": "Inverter", "children": ["x"]}, "x": LEAF}
    found = find(check_reachability, make_project(nodes, trees={"Other": other}), "BT0114")
    assert [(step.tree, step.node, step.results) for step in found.path] == [
        ("MainTree", "n1", ("FAILURE",)),
        ("MainTree", "a", ("FAILURE",)),
        ("Other", "n1", ("FAILURE",)),
        ("Other", "x", ("SUCCESS",)),
    ]
    assert "Other/Inverter (FAILURE) → Other/AlwaysSuccess (SUCCESS)" in str(found)


def test_one_cause_is_said_once(make_project):
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b", "c"]},
        "a": {"type": "AlwaysFailure"},
        "b": {"type": "Fallback", "children": ["d", "e"]},
        "c": LEAF,
        "d": LEAF,
        "e": LEAF,
    }
    found = findings(check_reachability, make_project(nodes))
    assert [(item.code, item.place.node) for item in found] == [("BT0114", "b")]


@pytest.mark.parametrize(
    "nodes",
    [
        {"n1": {"type": "Repeat", "ports": {"num_cycles": "{n}"}, "children": ["a"]}, "a": LEAF},
        {"n1": {"type": "Parallel", "children": ["a", "b"]}, "a": LEAF, "b": LEAF},
        {
            "n1": {"type": "Sequence", "children": ["a", "b"]},
            "a": {"type": "AlwaysFailure", "disabled": True},
            "b": LEAF,
        },
        {"n1": {"type": "Switch2", "children": ["a", "b", "c"]}, "a": LEAF, "b": LEAF, "c": LEAF},
        {"n1": {"type": "TryCatch", "children": ["a", "b"]}, "a": {"type": "ScriptCondition"}, "b": LEAF},
    ],
)
def test_what_can_be_ticked_is_not_reported(make_project, nodes):
    assert findings(check_reachability, make_project(nodes)) == []
