"""A project as one document."""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

import py_trees
import pytest

from tests.translator.check.finding import LEAF
from translator.xml.read import read_document
from translator.xml.write import RESERVED_TAGS, cpp_type, ordered_trees, tag_of, write_document
from tree_gardener import Status, Tree


def test_the_main_tree_comes_first_and_the_models_last(make_project):
    project = make_project(
        {"n1": {"type": "Act", "ports": {"speed": "1"}}},
        trees={"Another": {"n1": LEAF}},
        main_tree="MainTree",
    )
    root = ElementTree.fromstring(write_document(project))  # noqa: S314 - our own text
    assert root.get("main_tree_to_execute") == "MainTree"
    assert [child.tag for child in root][-1] == "TreeNodesModel"
    assert {tree.id for tree in ordered_trees(project)} == {"MainTree", "Another"}


def test_a_node_is_named_by_its_type(make_project):
    project = make_project({"n1": LEAF})
    assert tag_of(project.trees["MainTree"].nodes["n1"], project) == ("AlwaysSuccess", {})


@pytest.mark.parametrize("type_", sorted(RESERVED_TAGS))
def test_a_type_that_xml_reserves_has_the_explicit_form_and_runs(make_project, type_):
    project = make_project({"n1": {"type": type_, "name": "go"}})
    text = write_document(project)
    assert f'<Action ID="{type_}" name="go"' in text
    (source,) = read_document(text, file="t.xml").trees
    assert [(node.type, node.name) for node in source.tree.walk()] == [(type_, "go")]

    class Done(py_trees.behaviour.Behaviour):
        def update(self):
            return py_trees.common.Status.SUCCESS

    tree = Tree.from_xml(text, {type_: Done})
    tree.setup()
    assert tree.tick_once() == Status.SUCCESS


def test_types_of_ports_are_those_of_the_library():
    assert cpp_type("int") == "int"
    assert cpp_type("string") == "std::string"
    assert cpp_type("any") is None


def test_a_tree_keeps_what_it_says_of_itself(make_project):
    project = make_project({"n1": LEAF})
    said = {"_description": "Goes <home>.", "_bts_offered": "1"}
    tree = replace(project.trees["MainTree"], attributes={**said, "name": "x"})
    text = write_document(replace(project, trees={"MainTree": tree}))
    (source,) = read_document(text, file="t.xml").trees
    assert dict(source.tree.attributes) == said
