"""Merged files: diagrams and XML."""

from __future__ import annotations

import json

import pytest

from tests.shared.make_differences import OLDER, changed
from translator import TranslatorError, from_xml
from translator.check.conflict import conflicts_of
from translator.diagram import restore
from translator.merge.files import NotMergeableError, merge_files, read_diagram

XML = """<?xml version="1.0"?>
<root BTCPP_format="4">
  <!-- ours to keep -->
  <BehaviorTree ID="Main">
    <Sequence>
      <Move   speed="1"  to='door'/>
      <Talk text="hi"/>{}
    </Sequence>
  </BehaviorTree>
</root>
"""


def raw(document):
    return json.dumps(document).encode()


def merged(ours, theirs, base=OLDER):
    return merge_files(
        *(each if isinstance(each, bytes) else raw(each) for each in (base, ours, theirs)), file="t.json"
    )


def test_diagrams():
    done = merged(changed(a={"name": "x"}), changed(c={"name": "y", "later": [1]}))
    assert done.conflicts == ()
    document = json.loads(done.data)
    assert (document["nodes"]["a"]["name"], document["nodes"]["c"]["name"]) == ("x", "y")
    assert document["nodes"]["c"]["later"] == [1]
    assert done.data.count(b"\n") > len(document["nodes"])


def test_conflicts_are_in_the_file_and_the_file_is_readable():
    done = merged(changed(c={"name": "x"}), changed(c={"name": "y"}))
    tree, found = restore(done.data, file="t.json")
    assert not found
    (conflict,) = conflicts_of(tree)
    assert (conflict["op"], conflict["base"], conflict["ours"], conflict["theirs"]) == (
        "rename",
        "left",
        "x",
        "y",
    )
    assert done.conflicts == (("MainTree", conflict),)


def test_a_side_without_changes_gives_the_bytes_of_the_other():
    assert merged(OLDER, b" [1") == merged(b" [1", b" [1") == merged(b" [1", OLDER)
    assert merged(OLDER, b" [1").data == b" [1"


def test_both_are_new():
    done = merged(OLDER, changed(c={"name": "y"}), base=b"")
    assert [conflict["node"] for _, conflict in done.conflicts] == ["c"]


@pytest.mark.parametrize("bad", [b"{", b"[]", b'{"format": "other"}', b"<<<<<<< ours"])
def test_a_file_that_cannot_be_read_says_why(bad):
    with pytest.raises(TranslatorError):
        merged(changed(c={"name": "y"}), bad)
    with pytest.raises(TranslatorError):
        read_diagram(bad, "t.json")


PLAIN = XML.format("")


def xml(ours, theirs, base=PLAIN):
    return merge_files(base.encode(), ours.encode(), theirs.encode(), file="t.xml")


def test_xml_keeps_the_style_of_ours():
    ours = XML.format("").replace('"hi"', '"hello"')
    done = xml(ours, XML.format('\n      <Wait s="3"/>').replace('speed="1"', 'speed="2"'))
    assert done.conflicts == ()
    text = done.data.decode()
    assert "<Move   speed=\"2\"  to='door'/>" in text
    assert '<Talk text="hello"/>' in text
    assert "<!-- ours to keep -->" in text
    assert [node.type for node in from_xml(text, stubs=False).main.walk()] == [
        "Sequence",
        "Move",
        "Talk",
        "Wait",
    ]


def test_conflicts_in_xml_are_an_attribute_that_check_reads():
    done = xml(XML.format("").replace("hi", "one"), XML.format("").replace("hi", "two"))
    tree = from_xml(done.data, stubs=False).main
    assert [(each["op"], each["ours"], each["theirs"]) for each in conflicts_of(tree)] == [
        ("change", "one", "two")
    ]
    assert 'text="one"' in done.data.decode()


def test_conflicts_in_xml_name_nodes_by_the_numbers_that_a_reader_gives():
    theirs = PLAIN.replace("<Sequence>", "<Sequence>\n      <First/>").replace("hi", "two")
    done = xml(PLAIN.replace("hi", "one"), theirs)
    tree = from_xml(done.data, stubs=False).main
    (conflict,) = conflicts_of(tree)
    assert tree.nodes[conflict["node"]].type == "Talk"
    assert done.conflicts == (("Main", conflict),)


def test_orders_and_places_in_xml_are_numbered_too():
    three = '<root BTCPP_format="4"><BehaviorTree ID="T"><Sequence>{}</Sequence></BehaviorTree></root>'
    base, ours, theirs = (
        three.format(each) for each in ("<A/><B/><C/>", "<New/><C/><A/><B/>", "<B/><A/><C/>")
    )
    tree = from_xml(xml(ours, theirs, base).data, stubs=False).main
    (conflict,) = conflicts_of(tree)
    assert conflict["op"] == "reorder"
    assert [tree.nodes[node].type for node in conflict["theirs"]] == ["B", "A", "C"]


def test_two_roots_in_xml_are_left_to_a_merge_of_lines():
    one = '<root BTCPP_format="4"><BehaviorTree ID="T">{}</BehaviorTree></root>'
    with pytest.raises(NotMergeableError):
        xml(one.format("<B/>"), one.format("<C/>"), one.format("<A/>"))


def test_trees_that_come_and_go():
    second = '<BehaviorTree ID="{}"><Talk text="{}"/></BehaviorTree></root>'
    base = XML.format("").replace("</root>", second.format("Old", "a"))
    ours = base.replace("hi", "hello")
    added = base.replace("</root>", second.format("New", "b"))
    assert set(from_xml(xml(ours, added, base).data, stubs=False).trees) == {
        "Main",
        "Old",
        "New",
    }
    gone = xml(ours, XML.format(""), base)
    assert gone.conflicts == ()
    assert set(from_xml(gone.data, stubs=False).trees) == {"Main"}
    kept = xml(base.replace('"a"', '"edited"'), XML.format("").replace("hi", "x"), base)
    assert [(tree, each["op"]) for tree, each in kept.conflicts] == [("Old", "delete")]


def test_comments_and_models_are_left_to_a_merge_of_lines():
    with pytest.raises(NotMergeableError):
        xml(XML.format("").replace("hi", "x"), XML.format("<!-- theirs -->"))
    with pytest.raises(NotMergeableError):
        xml(XML.format("").replace("hi", "x"), XML.format("").replace("ours to keep", "edited"))
    with pytest.raises(NotMergeableError):
        xml(XML.format("").replace("hi", "x"), XML.format("").replace(' BTCPP_format="4"', ""))
