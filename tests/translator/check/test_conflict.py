"""A tree in which a merge has left a decision does not run."""

from __future__ import annotations

import json

from tests.translator.check.finding import LEAF, find, findings
from translator import check, load
from translator.check.conflict import check_conflicts, conflicts_of, sentence
from translator.tree import CONFLICTS, Tree

CONFLICT = {"op": "change", "node": "n1", "field": "ports.speed", "base": "1", "ours": "2", "theirs": None}


def project_with(*conflicts):
    document = {
        "format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "n1",
        "nodes": {"n1": LEAF}, "drafts": [], "conflicts": list(conflicts),
    }  # fmt: skip
    return load({"trees/MainTree.json": json.dumps(document).encode()})


def test_it_is_an_error_at_the_node():
    found = find(check_conflicts, project_with(CONFLICT), "BT0116")
    assert found.is_error
    assert (found.place.tree, found.place.node) == ("MainTree", "n1")
    assert "(ports.speed): ours “2”, theirs ∅." in found.message
    assert "BT0116" in {item.code for item in check(project_with(CONFLICT))}


def test_entries_of_any_form_count():
    assert len(findings(check_conflicts, project_with({}, 5, {"node": [1]}))) == 3
    assert findings(check_conflicts, project_with()) == []


def test_conflicts_of_xml():
    tree = Tree("T", None, {}, attributes={CONFLICTS: json.dumps([CONFLICT])})
    assert conflicts_of(tree) == (CONFLICT,)
    for text in ("", "{", "7"):
        assert conflicts_of(Tree("T", None, {}, attributes={CONFLICTS: text})) == ({},)


def test_a_sentence_for_the_command_line():
    assert sentence(CONFLICT) == "ports.speed [n1]: ours “2”, theirs ∅"
