"""Shape: known nodes, counts of children, names, roots, drafts."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF, find, findings, is_found_at_its_place
from translator import Severity, load
from translator.check.structure import check_structure

CASES = {
    "unknown node": ("BT0102", {"n1": {"type": "Sequenze"}}, "n1"),
    "draft": ("BT0103", {"n1": LEAF, "n2": LEAF}, "n2"),
    "too few children": ("BT0104", {"n1": {"type": "Sequence"}}, "n1"),
    "too many children": (
        "BT0104",
        {"n1": {"type": "Inverter", "children": ["a", "b"]}, "a": LEAF, "b": LEAF},
        "n1",
    ),
    "leaf with a child": ("BT0104", {"n1": {"type": "Act", "children": ["a"]}, "a": LEAF}, "n1"),
    "disabled": ("BT0105", {"n1": {"type": "AlwaysSuccess", "disabled": True}}, "n1"),
    "same name": (
        "BT0108",
        {
            "n1": {"type": "Sequence", "children": ["a", "b"]},
            "a": {**LEAF, "name": "x"},
            "b": {**LEAF, "name": "x"},
        },
        "b",
    ),
    "tree as node": ("BT0111", {"n1": {"type": "Other"}}, "n1"),
    "unknown control": ("BT0112", {"n1": {"type": "RoundRobin", "children": ["a"]}, "a": LEAF}, "n1"),
    "two async": (
        "BT0113",
        {
            "n1": {"type": "ReactiveSequence", "children": ["a", "b"]},
            "a": {"type": "AsyncSequence", "children": ["c"]},
            "b": {"type": "AsyncSequence", "children": ["d"]},
            "c": LEAF,
            "d": LEAF,
        },
        "b",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_finding_and_its_place(make_project, name):
    is_found_at_its_place(check_structure, make_project, CASES[name])


def test_suggestion_of_the_nearest_name(make_project):
    assert "Sequence" in find(check_structure, make_project({"n1": {"type": "Sequenc"}}), "BT0102").hint


def test_missing_main_tree(make_project):
    found = find(check_structure, make_project({"n1": LEAF}, main_tree="MainTre"), "BT0100")
    assert found.place.file == "project.json"
    assert "MainTree" in found.hint


def test_a_universe_cannot_be_called_as_what_means_none():
    project = load({"trees/MainTree.json": b"{}", "universes/none.yaml": b"", "universes/nones.yaml": b""})
    (found,) = [item for item in findings(check_structure, project) if item.code == "BT0031"]
    assert found.is_error
    assert (found.place.file, found.place.line) == ("universes/none.yaml", 1)
    assert "universes/none.yaml" in found.hint


def test_empty_trees(make_project):
    assert find(check_structure, make_project({}), "BT0101").is_error
    project = make_project({"n1": LEAF}, trees={"Empty": {}})
    assert find(check_structure, project, "BT0115").severity is Severity.NOTE
    assert not [item for item in findings(check_structure, project) if item.is_error]
