"""Calls of trees: rings, names, ports."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF, findings, is_found_at_its_place
from translator.check.subtree import check_subtrees

CASES = {
    "unknown tree": ("BT0501", {"n1": {"type": "SubTree", "tree": "Nope"}}, "n1"),
    "two subtrees of one name": (
        "BT0503",
        {
            "n1": {"type": "Sequence", "children": ["a", "b"]},
            "a": {"type": "SubTree", "tree": "Other", "name": "x"},
            "b": {"type": "SubTree", "tree": "Other", "name": "x"},
        },
        "b",
    ),
    "bad autoremap": (
        "BT0505",
        {"n1": {"type": "SubTree", "tree": "Other", "attributes": {"_autoremap": "maybe"}}},
        "n1",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_finding_and_its_place(make_project, name):
    is_found_at_its_place(check_subtrees, make_project, CASES[name])


def test_a_ring_of_subtrees_is_one_finding(make_project):
    call = {"n1": {"type": "SubTree", "tree": "B"}}
    project = make_project(
        {"n1": {"type": "SubTree", "tree": "A"}},
        trees={"A": call, "B": {"n1": {"type": "SubTree", "tree": "A"}}},
    )
    rings = [item for item in findings(check_subtrees, project) if item.code == "BT0502"]
    assert [item.place.tree for item in rings] == ["B"]
    assert "A → B → A" in rings[0].message


def test_each_ring_is_a_finding_of_its_own(make_project):
    def call(*targets):
        nodes = {f"n{target}": {"type": "SubTree", "tree": target} for target in targets}
        return {"n1": {"type": "Sequence", "children": list(nodes)}, **nodes}

    project = make_project(call("A", "A", "C"), trees={"A": call("A", "B"), "B": call("A"), "C": call("C")})
    rings = [
        (item.place.tree, item.place.node)
        for item in findings(check_subtrees, project)
        if item.code == "BT0502"
    ]
    assert rings == [("A", "nA"), ("B", "nA"), ("C", "nC")]


def test_other_spellings_of_root_name_a_tree(make_project):
    project = make_project({"n1": {"type": "SubTree", "tree": "ROOT"}}, trees={"ROOT": {"n1": LEAF}})
    assert [item.code for item in findings(check_subtrees, project)] == []
