"""Scripts that are in an entry."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import findings, is_found_at_its_place
from translator import from_xml
from translator.check.late_script import check_late_scripts

CASES = {
    "script in an entry": ("BT0303", {"n1": {"type": "Script", "ports": {"code": "{k}"}}}, "n1"),
}


@pytest.mark.parametrize("name", CASES)
def test_finding_and_its_place(make_project, name):
    is_found_at_its_place(check_late_scripts, make_project, CASES[name])


CONSTANT = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence><SubTree ID="Run" {given}/></Sequence></BehaviorTree>
<BehaviorTree ID="Run"><SubTree ID="Inner" code="{code}"/></BehaviorTree>
<BehaviorTree ID="Inner"><Script code="{code}"/></BehaviorTree></root>"""


@pytest.mark.parametrize(
    ("given", "codes"), [('code="x := 1"', []), ("", ["BT0303"]), ('code="{later}"', ["BT0303"])]
)
def test_a_script_may_be_a_constant_of_its_subtree(given, codes):
    found = findings(check_late_scripts, from_xml(CONSTANT.replace("{given}", given)))
    assert [item.code for item in found if item.code == "BT0303"] == codes
