"""Actions that the trees use and nobody has written."""

from __future__ import annotations

from tests.translator.check.finding import find, findings
from translator.check.action import check_actions
from translator.stub import stub_source


def test_a_stub_is_reported_at_the_node_that_uses_it(make_project):
    project = make_project({"n1": {"type": "Later"}}, actions={"Later": stub_source("Later", None, [])})
    found = find(check_actions, project, "BT0613")
    assert (found.place.node, found.values["path"]) == ("n1", "actions/Later.py")


def test_a_stub_that_no_tree_uses_is_not_reported(make_project):
    project = make_project({"n1": {"type": "Act"}}, actions={"Later": stub_source("Later", None, [])})
    assert findings(check_actions, project) == []
