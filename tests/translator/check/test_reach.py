"""Children that can never be ticked."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF, findings, is_found_at_its_place
from translator.check.reach import check_reachability

CASES = {
    "unreachable in a fallback": (
        "BT0114",
        {"n1": {"type": "Fallback", "children": ["a", "b"]}, "a": LEAF, "b": LEAF},
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
