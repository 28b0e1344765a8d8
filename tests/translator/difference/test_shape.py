"""A diagram with its links, and what its nodes say."""

from __future__ import annotations

from tests.shared.make_differences import OLDER
from translator.difference.shape import ROOT, Shape, fields, text, tree_fields


def test_links_in_both_directions():
    shape = Shape(OLDER)
    assert shape.order == ("r", "a", "b", "d", "c", "s", "e", "f", "z")
    assert shape.branch("s") == ("s", "e", "f")
    assert (shape.parents["r"], shape.parents["d"], shape.parents["z"]) == (ROOT, "b", None)
    assert (shape.children(ROOT), shape.children(None)) == (("r",), ("z",))
    assert (shape.index("c"), shape.index("z")) == (2, 0)


def test_defaults_are_not_said_but_an_empty_name_is():
    row = {"type": "Turn", "name": "", "comment": "", "disabled": False, "ports": {"b": "1", "a": "2"}}
    assert fields(row) == {"type": "Turn", "name": "", "ports.a": "2", "ports.b": "1"}
    assert fields({"type": "A", "position": [1, 2]}, layout=True) == {"type": "A", "position": "[1,2]"}


def test_what_a_tree_says():
    document = {
        **OLDER,
        "attributes": {"_x": "1"},
        "ports": [{"name": "p", "type": "int"}],
        "layout": "horizontal",
    }
    assert tree_fields(document) == {"id": "MainTree", "ports.p": '{"type":"int"}', "attributes._x": "1"}
    assert tree_fields(document, layout=True)["layout"] == "horizontal"


def test_values_are_texts():
    assert text({"b": [1], "a": True}) == '{"a":true,"b":[1]}'
