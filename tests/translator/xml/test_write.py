"""A project as one document."""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

from tests.translator.check.finding import LEAF
from translator.xml.read import read_document
from translator.xml.write import cpp_type, ordered_trees, tag_of, write_document


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
    assert tag_of(project.trees["MainTree"].nodes["n1"], project) == "AlwaysSuccess"


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
