"""A project made of XML."""

from __future__ import annotations

import pytest

from translator import TranslatorError
from translator.importer import from_xml

TREE = '<root BTCPP_format="4"><BehaviorTree ID="Main"><Drive speed="1"/></BehaviorTree></root>'
PARTS = """<root BTCPP_format="4" main_tree_to_execute="Main"><include path="other.xml"/>
<BehaviorTree ID="Main"><SubTree ID="Other"/></BehaviorTree></root>"""
OTHER = '<root BTCPP_format="4"><BehaviorTree ID="Other"><AlwaysSuccess/></BehaviorTree></root>'


def test_an_action_that_is_missing_gets_a_stub() -> None:
    project = from_xml(TREE)
    assert list(project.actions) == ["Drive"]
    assert "speed" in project.actions["Drive"].source
    assert list(from_xml(TREE, stubs=False).actions) == []


def test_trees_of_included_files_are_there() -> None:
    project = from_xml(PARTS, file="main.xml", included={"other.xml": OTHER.encode()})
    assert set(project.trees) == {"Main", "Other"}
    assert project.settings.main_tree == "Main"


def test_what_is_no_xml_is_refused_with_its_place() -> None:
    with pytest.raises(TranslatorError) as caught:
        from_xml("<root>")
    assert all(found.place.line for found in caught.value.diagnostics)
