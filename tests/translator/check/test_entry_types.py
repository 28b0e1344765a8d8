"""Types of blackboard entries: the check finds what BehaviorTree.CPP 4.10 refuses at loading, and no more."""

from __future__ import annotations

import json
from typing import Any

import pytest

from tests.translator.check.finding import LEAF, find, findings, is_found_at_its_place
from tests.translator.conftest import ROOT
from translator import check, from_xml
from translator.check.entry_types import check_entry_types
from translator.diagnostic import Severity

CORPUS = (ROOT / "tests/conformance/entry_types.jsonl").read_text(encoding="utf-8")
CASES: list[dict[str, Any]] = [json.loads(line) for line in CORPUS.splitlines()]
TYPES = {"Int": "int", "Str": "str", "Double": "float", "Bool": "bool"}
SOURCE = """
import py_trees
from tree_gardener.ports import Port


class {name}(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {{"value": Port({type})}}
    OUTPUT_PORTS = {{{output}}}

    def update(self):
        return py_trees.common.Status.SUCCESS
"""
ACTIONS = {
    f"{verb}{name}.py": SOURCE.format(
        name=f"{verb}{name}", type=type_, output=f'"to": Port({type_})' if verb == "Set" else ""
    ).encode()
    for verb in ("Get", "Set")
    for name, type_ in TYPES.items()
} | {
    f"GetInt{name}.py": SOURCE.format(
        name=f"GetInt{name}", type=f'int, default="{default}"', output=""
    ).encode()
    for name, default in (("BB", "{dflt}"), ("Same", "{=}"))
}
TOLD = {  # the engine finds these when it ticks
    "a Switch before an integer": "BT0407",
    "a list after an integer": "BT0210",
}


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["name"])
def test_what_is_refused_has_an_error_and_what_loads_has_none(case: dict[str, Any]) -> None:
    found = check(from_xml(case["xml"], actions=ACTIONS, stubs=False))
    errors = {item.code for item in found if item.is_error}
    assert bool(errors) == case.get("rejected_410", False), [str(item) for item in found]
    assert errors <= {"BT0210", "BT0214"}
    if case["name"] in TOLD:
        assert TOLD[case["name"]] in {item.code for item in found if item.severity is Severity.WARNING}


BOTH = {
    "n1": {"type": "Sequence", "children": ["a", "b"]},
    "a": {"type": "Act", "ports": {"result": "{k}"}},
    "b": {"type": "Act", "ports": {"count": "{k}"}},
}


def test_finding_and_its_place(make_project) -> None:
    is_found_at_its_place(check_entry_types, make_project, ("BT0210", BOTH, "b"))


def test_a_conflict_through_a_subtree_names_the_other_tree(make_project) -> None:
    call = {"type": "SubTree", "tree": "Inner", "ports": {"x": "{k}"}}
    nodes = {**BOTH, "b": call}
    inner = {"n1": {"type": "Act", "ports": {"count": "{x}"}}}
    project = make_project(nodes, trees={"Inner": inner})
    found = find(check_entry_types, project, "BT0214")
    assert found.place.tree == "Inner"
    assert "MainTree" in found.message


def test_trees_that_call_each_other_often_are_visited_within_a_bound(make_project) -> None:
    trees = {
        f"T{level}": {
            "n1": {"type": "Sequence", "children": list("abcdefgh")},
            **{name: {"type": "SubTree", "tree": f"T{level + 1}"} for name in "abcdefgh"},
        }
        for level in range(9)
    }
    project = make_project(trees["T0"], trees={**trees, "T9": {"n1": LEAF}})
    assert findings(check_entry_types, project) == []
