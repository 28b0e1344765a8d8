"""Exports of a project: XML, the imported files, one file with all sources."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF
from translator import TranslatorError, from_xml, load
from translator.export import (
    export_files,
    require_sound,
    self_contained,
    to_xml,
    unwritten_actions,
    used_actions,
)
from translator.stub import stub_source

XML = '<root BTCPP_format="4"><BehaviorTree ID="A"><AlwaysSuccess/></BehaviorTree></root>'


def test_an_imported_file_that_nobody_changed_is_given_back() -> None:
    project = from_xml(XML, file="a.xml")
    assert to_xml(project) == XML
    assert export_files(project) == {"a.xml": XML.encode()}


def test_a_project_without_imports_is_named_after_its_main_tree(make_project):
    project = make_project({"n1": LEAF})
    assert list(export_files(project)) == ["MainTree.xml"]
    assert export_files(project)["MainTree.xml"].decode() == to_xml(project)


def test_a_project_with_errors_is_not_exported(make_project):
    project = make_project({"n1": {"type": "SubTree", "tree": "Nope"}})
    with pytest.raises(TranslatorError) as caught:
        require_sound(project)
    assert [found.code for found in caught.value.diagnostics] == ["BT0501"]


def test_one_file_holds_the_actions_that_are_used(make_project):
    project = make_project({"n1": {"type": "Open"}})
    assert [action.name for action in used_actions(project)] == ["Open"]
    text = self_contained(project)
    assert '<Action name="Open" sha256="' in text
    assert 'name="Act"' not in text


def test_actions_that_are_stubs_are_named(make_project):
    stub = {"Later": stub_source("Later", None, []), "Never": stub_source("Never", None, [])}
    assert unwritten_actions(make_project({"n1": {"type": "Later"}}, actions=stub)) == ["Later"]
    assert unwritten_actions(load({"trees/MainTree.json": b"{}"})) == []
