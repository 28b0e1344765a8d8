"""The text of one tree: nodes keep their ids, and the text keeps its author's comments and blanks."""

from __future__ import annotations

import re

import pytest
from hypothesis import HealthCheck, given, settings

from tests.budget import count
from tests.translator.strategies import trees
from translator import Node, TranslatorError, Tree
from translator.tree_text import read_tree_text, write_tree_text

NODES = {
    "n1": Node("n1", "Sequence", name="go", children=("n4", "n2"), position=(10, 20)),
    "n2": Node("n2", "Forward", ports={"speed": "0.5"}),
    "n4": Node("n4", "Turn", ports={"speed": "{v}"}, comment="a bit"),
    "n9": Node("n9", "AlwaysSuccess"),
}
TREE = Tree("Main", "n1", NODES, drafts=("n9",), file="trees/Main.json")


ROOT = '<root BTCPP_format="4">\n{}</root>'


def said(xml, node, ranges):
    found = next(item for item in ranges if item.node == node)
    units = xml.encode("utf-16-le")
    return units[2 * found.start : 2 * found.open_end].decode("utf-16-le")


def test_text_and_tree_say_the_same():
    text = write_tree_text(TREE)
    assert text.xml == (
        '<root BTCPP_format="4">\n  <BehaviorTree ID="Main">\n'
        '    <Sequence name="go" _bts_id="n1" _bts_pos="10;20">\n'
        '      <Turn speed="{v}" _description="a bit" _bts_id="n4"/>\n'
        '      <Forward speed="0.5" _bts_id="n2"/>\n'
        "    </Sequence>\n  </BehaviorTree>\n</root>\n"
    )
    read = read_tree_text(text.xml, TREE)
    assert read.tree == TREE
    assert read.text == text
    assert text.ids == ["n1", "n4", "n2"]


@settings(
    max_examples=count("translator_round_trip") // 4,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
@given(trees(), trees())
def test_any_tree_can_be_patched_into_the_text_of_any_other(one, other):
    text = write_tree_text(one)
    assert read_tree_text(text.xml, one).tree == one
    assert read_tree_text(re.sub(' _bts_id="[^"]*"', "", text.xml), one).tree == one
    patched = write_tree_text(other, base=text.xml, ids=text.ids)
    assert read_tree_text(patched.xml, other).tree == other


@pytest.mark.parametrize("name", ["go", "ir — ¿🤖?"])
def test_ranges_count_as_editors_do(name):
    text = write_tree_text(TREE.edited("n1", name=name))
    assert said(text.xml, "n2", text.ranges) == '<Forward speed="0.5" _bts_id="n2"/>'


def test_a_changed_tree_is_patched_into_the_text():
    xml = write_tree_text(TREE).xml.replace("    <Sequence", "    <!-- why -->\n    <Sequence")
    read = read_tree_text(xml, TREE)
    assert read.tree == TREE
    later = read.tree.edited("n2", ports={"speed": "1"}).inserted(Node("n5", "Stop"), parent="n1")
    text = write_tree_text(later, base=xml, ids=read.text.ids)
    assert text.xml == xml.replace('"0.5" _bts_id="n2"/>', '"1" _bts_id="n2"/>\n      <Stop _bts_id="n5"/>')
    assert text.ids == ["n1", "n4", "n2", "n5"]


def test_nodes_without_ids_keep_those_they_had():
    children = '<Forward speed="0.7"/><Wait/><Turn speed="{v}"/>'
    tree = f'<BehaviorTree ID="Main"><Sequence name="go">{children}</Sequence></BehaviorTree>'
    read = read_tree_text(ROOT.format(tree), TREE)
    root = read.tree.nodes["n1"]
    assert root.children == ("n2", "n3", "n4")
    assert read.tree.nodes["n3"].type == "Wait"
    assert read.tree.drafts == ("n9",)
    # Written back, the text is still its author's, and has no ids.
    again = write_tree_text(read.tree.edited("n3", type="Stop"), base=read.text.xml, ids=read.text.ids)
    assert again.xml == read.text.xml.replace("Wait", "Stop")


def test_new_nodes_take_no_id_that_another_had():
    xml = write_tree_text(TREE).xml
    pasted = '<Turn speed="{v}" _bts_id="n4"/><New _bts_id="n9"/>'
    first = xml.replace('<Forward speed="0.5" _bts_id="n2"/>', pasted)
    tree = read_tree_text(first, TREE).tree
    copy, new = tree.nodes["n1"].children[1:]
    assert (tree.nodes[copy].type, tree.nodes[new].type) == ("Turn", "New")
    assert copy != "n4"
    assert new not in {"n9", copy}
    assert tree.nodes["n9"].type == "AlwaysSuccess"


def test_a_tree_can_be_emptied_and_begun():
    empty = read_tree_text('<root BTCPP_format="4"><BehaviorTree ID="Main"/></root>', TREE).tree
    assert (empty.root, list(empty.nodes)) == (None, ["n9"])
    text = write_tree_text(empty)
    begun = read_tree_text(text.xml.replace("/>", "><Stop/></BehaviorTree>"), empty).tree
    assert begun.nodes[begun.root].type == "Stop"


def test_v3_and_foreign_encodings_are_read():
    tree = '<BehaviorTree ID="Main"><SequenceStar name="ñ"><A/></SequenceStar></BehaviorTree>'
    xml = f'<?xml version="1.0" encoding="ISO-8859-1"?><root>{tree}</root>'
    read = read_tree_text(xml, TREE)
    assert (read.tree.nodes["n1"].type, read.tree.nodes["n1"].name) == ("SequenceWithMemory", "ñ")
    assert [item.code for item in read.diagnostics] == ["BT0720"]


@pytest.mark.parametrize(
    ("xml", "code", "line"),
    [
        (ROOT.format('<BehaviorTree ID="Main">\n<Sequence>\n</BehaviorTree>'), "BT0701", 4),
        (ROOT.format('<BehaviorTree ID="Other"><A/></BehaviorTree>'), "BT0737", 2),
        (ROOT.format(""), "BT0738", 1),
        (ROOT.format('<BehaviorTree ID="Main"/><BehaviorTree ID="B"/>'), "BT0738", 1),
        (ROOT.format('<BehaviorTree ID="Main"><A/><B/></BehaviorTree>'), "BT0739", 2),
        (ROOT.format('<BehaviorTree ID="Main">\n<Action/></BehaviorTree>'), "BT0716", 3),
        ("<!DOCTYPE x><root/>", "BT0704", 1),
        ("", "BT0701", 1),
    ],
)
def test_unreadable_text_is_reported_at_its_line(xml, code, line):
    with pytest.raises(TranslatorError) as refused:
        read_tree_text(xml, TREE)
    (found,) = refused.value.diagnostics
    assert (found.code, found.place.line) == (code, line)
