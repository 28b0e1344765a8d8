"""Scripts in ports and conditions."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF, findings, is_found_at_its_place
from translator.check.script import check_scripts

CASES = {
    "blank script": ("BT0301", {"n1": {"type": "Script", "ports": {"code": " "}}}, "n1"),
    "no condition": ("BT0301", {"n1": {"type": "ScriptCondition", "ports": {"code": ""}}}, "n1"),
    "script beyond 64 bits": ("BT0304", {"n1": {"type": "Script", "ports": {"code": f"x := {2**63}"}}}, "n1"),
    "empty condition": ("BT0301", {"n1": {**LEAF, "conditions": {"_skipIf": " "}}}, "n1"),
    "bad script": ("BT0302", {"n1": {"type": "Script", "ports": {"code": "x := "}}}, "n1"),
    "bad condition of messages": (
        "BT0302",
        {"n1": {"type": "RosSubscribe", "ports": {"condition": "percentage <"}}},
        "n1",
    ),
    "bad condition": ("BT0302", {"n1": {**LEAF, "conditions": {"_skipIf": "x =="}}}, "n1"),
}


@pytest.mark.parametrize("name", CASES)
def test_finding_and_its_place(make_project, name):
    is_found_at_its_place(check_scripts, make_project, CASES[name])


def test_a_field_of_a_field_has_its_own_advice(make_project):
    for condition in ("pose.position.x > 1", "pose__position__x > 1", "{entry}", " "):
        nodes = {"n1": {"type": "RosSubscribe", "ports": {"condition": condition}}}
        found = findings(check_scripts, make_project(nodes))
        assert [item.code for item in found] == (["BT0302"] if "." in condition else [])
        assert all("with __: pose__position__x" in f"{item.message} {item.hint}" for item in found)


def test_what_can_be_read_is_not_reported(make_project):
    nodes = {"n1": {"type": "Script", "ports": {"code": "x := 1"}, "conditions": {"_skipIf": "false"}}}
    assert findings(check_scripts, make_project(nodes)) == []
