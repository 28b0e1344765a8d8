"""Findings that a node silences, in diagrams and in XML."""

from __future__ import annotations

import json
from typing import Any

import pytest

from tests.translator.conftest import diagram_bytes
from translator import from_xml, to_xml
from translator.check import check
from translator.check.context import Context
from translator.check.silence import without_silenced
from translator.merge import merge_documents

LEAF = {"type": "AlwaysSuccess"}
REASON = "it fails as soon as the camera is there"


def nodes(**silenced):
    return {"n1": {"type": "ForceSuccess", "children": ["a"], "silenced": silenced}, "a": LEAF}


def codes(project):
    return [item.code for item in check(project)]


def test_a_silenced_finding_is_not_reported(make_project):
    assert codes(make_project(nodes())) == ["BT0119"]
    assert codes(make_project(nodes(BT0119=REASON))) == []
    assert codes(make_project(nodes(BT0402=REASON))) == ["BT0119"]


@pytest.mark.parametrize(
    ("silenced", "found"),
    [
        ({"BT0119": " "}, ["BT0119", "BT0127"]),
        ({"BT9999": REASON}, ["BT0119", "BT0128"]),
        ({"no code": REASON}, ["BT0119", "BT0128"]),
    ],
)
def test_a_silence_that_does_not_count_is_reported(make_project, silenced, found):
    assert sorted(codes(make_project(nodes(**silenced)))) == found


def test_an_error_cannot_be_silenced(make_project):
    wrong = {"n1": {"type": "Nothing", "silenced": {"BT0102": REASON}}}
    assert sorted(codes(make_project(wrong))) == ["BT0102", "BT0126"]


def test_other_nodes_are_still_looked_at(make_project):
    rows: dict[str, Any] = {"n1": {"type": "Sequence", "children": ["x", "y"]}}
    rows |= {"x": {"type": "ForceSuccess", "children": ["a"], "silenced": {"BT0119": REASON}}, "a": LEAF}
    rows |= {"y": {"type": "ForceSuccess", "children": ["b"]}, "b": LEAF}
    context = Context(make_project(rows))
    context.report("BT0119", context.project.trees["MainTree"], None, node="", type="", child="", says="")
    assert [item.place.node for item in check(make_project(rows))] == ["y"]
    assert len(without_silenced(context)) == 1


def test_xml_carries_it_there_and_back(make_project):
    text = to_xml(make_project(nodes(BT0119='"so" & <so>')))
    assert "_bts_silenced=" in text
    again = from_xml(text)
    assert next(again.main.walk()).silenced == {"BT0119": '"so" & <so>'}
    assert codes(again) == []


@pytest.mark.parametrize("value", ["later", "[1]", "{&quot;BT0119&quot;: 1}"])
def test_what_cannot_be_read_in_xml_is_kept_and_reported(value):
    leaf = f'<AlwaysSuccess _bts_silenced="{value}"/>'
    project = from_xml(f'<root BTCPP_format="4"><BehaviorTree ID="A">{leaf}</BehaviorTree></root>')
    assert codes(project) == ["BT0128"]
    assert next(project.main.walk()).silenced == {"?": value.replace("&quot;", '"')}


def test_merge_takes_the_silences_of_both_sides():
    def document(**silenced):
        raw = diagram_bytes(
            {
                "n1": {
                    "type": "ForceSuccess",
                    "children": ["a"],
                    **({"silenced": silenced} if silenced else {}),
                },
                "a": LEAF,
            }
        )
        return {**json.loads(raw), "version": 2 if silenced else 1}

    merged = merge_documents(document(), document(BT0119="ours"), document(BT0402="theirs"))
    assert merged.conflicts == ()
    assert merged.document["nodes"]["n1"]["silenced"] == {"BT0119": "ours", "BT0402": "theirs"}
    assert merged.document["version"] == 2
    assert merge_documents(document(), document(), document(BT0119="theirs")).document["version"] == 2
    both = merge_documents(document(), document(BT0119="ours"), document(BT0119="theirs"))
    assert [item["field"] for item in both.conflicts] == ["silenced.BT0119"]
    gone = merge_documents(document(BT0119="x"), document(BT0119="x"), document())
    assert (gone.document["version"], "silenced" in gone.document["nodes"]["n1"]) == (1, False)
