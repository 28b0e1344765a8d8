"""Launch files in YAML and XML have one form."""

from __future__ import annotations

import pytest

from executor.launching.documents import read_document
from executor.universes.document import DocumentError

YAML = b"""launch:
- node: {pkg: a, param: [{name: b, value: c}]}
- group:
    scoped: "false"
    children: [{let: {name: d, value: e}}]
"""
XML = b"""<launch>
<node pkg="a"><param name="b" value="c"/></node>
<group scoped="false">
<let name="d" value="e"/></group>
</launch>"""


def test_both_formats_have_the_same_value_and_places():
    yaml, xml = read_document(YAML, "a.launch.yaml"), read_document(XML, "a.launch.xml")
    assert yaml.value == xml.value
    for path in (("launch", 0, "node"), ("launch", 0, "node", "param", 0)):
        assert yaml.place(path)[0] == xml.place(path)[0] == 2
    assert xml.place(("launch", 1, "group", "children", 0, "let", "name")) == (4, 1)


def test_a_text_that_is_not_utf_8_is_refused():
    with pytest.raises(DocumentError, match="not UTF-8"):
        read_document(b"launch: \xff", "a.launch.yaml")


def test_a_huge_file_is_refused():
    with pytest.raises(DocumentError, match="larger than"):
        read_document(b"<launch>" + b" " * 3_000_000 + b"</launch>", "a.launch.xml")
