"""XML with the position of every element."""

from __future__ import annotations

import pytest

from tests.tree_gardener.trees import document
from tree_gardener import LoadError, Tree
from tree_gardener.document import embedded_sources, parse_document


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("<!DOCTYPE root []><root/>", "TG103"),
        ("<root>&unknown;</root>", "TG102"),
        ("<root/><root/>", "TG102"),
        ("<root a='<'/>", "TG102"),
        ("<root>" + "<a>" * 2000 + "</a>" * 2000 + "</root>", "TG101"),
        ("   ", "TG102"),
    ],
)
def test_xml_from_outside_is_read_strictly(text: str, code: str) -> None:
    with pytest.raises(LoadError) as refused:
        parse_document(text)
    assert refused.value.diagnostics[0].code == code


def test_columns_count_characters() -> None:
    with pytest.raises(LoadError) as refused:
        Tree.from_xml(document('<Sequence name="größe"><Nope/></Sequence>').replace("<root", "\n<root"))
    problem = refused.value.diagnostics[0]
    line = document('<Sequence name="größe"><Nope/></Sequence>')
    assert (problem.line, problem.column) == (2, line.index("<Nope") + 1)


def test_the_sources_in_a_document_are_found_in_both_forms() -> None:
    text = '<root><Code><Action name="A">x = 1</Action><B>\n  y = 2\n</B></Code></root>'
    assert embedded_sources(parse_document(text)) == {"A": "x = 1", "B": "\ny = 2\n"}


def test_the_value_of_an_attribute_has_its_place() -> None:
    document = parse_document("<root>\n <A b = 'x &lt; y'/></root>")
    [element] = document.root.children
    offset = document.locate_value(element, "b")
    assert document.locate(offset) == (2, 10)
    assert document.data[document.skip(offset, 3) :].startswith(b" y")
