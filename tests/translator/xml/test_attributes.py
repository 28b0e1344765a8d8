"""The properties of a node as attributes, and back."""

from __future__ import annotations

from translator.tree import Node
from translator.xml.attributes import from_attributes, is_free, to_attributes

NODE = Node(
    "n1",
    "Drive",
    name="go",
    ports={"speed": "1"},
    conditions={"_skipIf": "x"},
    comment="why",
    position=(1.0, 2.5),
    collapsed=True,
)


def test_what_is_written_reads_back() -> None:
    fields = from_attributes(to_attributes(NODE), is_subtree=False)
    for name in ("id", "name", "ports", "conditions", "comment", "position", "collapsed"):
        assert fields[name] == getattr(NODE, name)


def test_a_disabled_node_keeps_its_own_condition_under_another_name() -> None:
    disabled = Node("n1", "Drive", disabled=True, conditions={"_skipIf": "x"})
    attributes = to_attributes(disabled)
    assert (attributes["_skipIf"], attributes["_bts_skipIf"]) == ("true", "x")
    fields = from_attributes(attributes, is_subtree=False)
    assert (fields["disabled"], fields["conditions"]) == (True, {"_skipIf": "x"})


def test_a_position_that_is_none_is_left_out_and_foreign_attributes_stay() -> None:
    assert from_attributes({"_bts_pos": "far"}, is_subtree=False)["position"] is None
    assert from_attributes({"_uid": "7"}, is_subtree=False)["attributes"] == {"_uid": "7"}
    assert is_free("_uid")
    assert not is_free("_skipIf")
    assert not is_free("speed")
