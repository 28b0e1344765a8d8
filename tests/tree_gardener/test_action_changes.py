"""Which actions changed, with what they import."""

from __future__ import annotations

import sys

import pytest

from tree_gardener.action_changes import remember_actions, unchanged
from tree_gardener.actions import load_actions

LEAF = "import py_trees\nclass {name}(py_trees.behaviour.Behaviour):\n    pass\n"


@pytest.mark.parametrize(
    "line",
    [
        "import helper",
        "import actions.helper",
        "from actions import helper",
        "from actions.helper import x",
        "from helper import x",
        "def f():\n    import helper as h",
    ],
)
def test_an_action_changed_if_what_it_imports_changed(line):
    before = {"A": line, "B": "import A", "C": "import os", "helper": "x = 1"}
    assert unchanged(before, before) == {"A", "B", "C", "helper"}
    assert unchanged(before, {**before, "helper": "x = 2"}) == {"C"}
    without = {name: source for name, source in before.items() if name != "helper"}
    assert unchanged(before, without) == {"C"}
    assert unchanged({"A": "def", "B": ""}, {"A": "def", "B": "", "N": ""}) == {"A", "B"}


def test_kept_actions_keep_their_modules_and_the_rest_can_be_undone():
    sources = {"Kept": LEAF.format(name="Kept"), "New": LEAF.format(name="New")}
    undo_all = remember_actions()
    first = load_actions(sources)
    undo = remember_actions()
    second = load_actions({**sources, "New": LEAF.format(name="New") + "\nx = 1\n"}, keep={"Kept"})
    assert second["Kept"] is first["Kept"]
    assert second["New"] is not first["New"]
    import actions.Kept  # type: ignore[import-not-found]

    assert actions.Kept is sys.modules["actions.Kept"]
    undo()
    assert sys.modules["actions.New"].New is first["New"]
    undo_all()
