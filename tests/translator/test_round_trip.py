"""Properties: diagram → XML → diagram → XML changes nothing; every tree loads in both engines."""

from __future__ import annotations

import re
import tempfile
from dataclasses import replace
from pathlib import Path

import behaviortreepy
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.budget import count
from tests.translator.conftest import OPEN_ACTION
from tests.translator.strategies import LEAVES, trees, without_braces
from translator import Project, Settings, Tree, check, from_xml, load, self_contained, to_xml
from translator.diagram import diagram_text, restore
from translator.importer import project_files
from translator.xml.read import read_document
from translator.xml.write import write_document
from tree_gardener import Tree as RunningTree

examples = settings(
    max_examples=count("translator_round_trip"),
    suppress_health_check=[HealthCheck.data_too_large, HealthCheck.too_slow],
)


def project_of(tree: Tree) -> Project:
    files = project_files(Settings(main_tree=tree.id), [tree])
    return load({**files, "actions/Open.py": OPEN_ACTION.format(name="Open").encode()})


def same(tree: Tree) -> Tree:
    """Returns the normal form: vertical is the default layout, and only the running part is in XML."""
    return replace(tree, layout="" if tree.layout == "vertical" else tree.layout)


@examples
@given(trees())
def test_diagram_file_reads_back(tree):
    again, found = restore(diagram_text(tree), file="trees/MainTree.json")
    assert found == ()
    assert same(again) == tree
    assert diagram_text(again) == diagram_text(tree)


@examples
@given(trees())
def test_xml_alone_restores_the_diagram(tree):
    text = write_document(project_of(tree))
    (source,) = read_document(text, file="t.xml").trees
    assert source.tree.root == tree.root
    assert dict(source.tree.nodes) == dict(tree.nodes)
    assert write_document(project_of(source.tree)) == text


@examples
@given(trees())
def test_every_tree_loads_in_tree_gardener_with_the_same_structure(tree):
    project = project_of(without_braces(tree))
    running = RunningTree.from_xml(self_contained(project))
    assert [node.node_id for node in running.nodes] == [node.id for node in tree.walk()]
    assert [node.type for node in running.nodes] == [node.type for node in tree.walk()]


@examples
@given(trees(leaves=LEAVES, plain=True))
def test_trees_of_built_in_nodes_load_in_behaviortree_cpp_with_the_same_structure(tree):
    assert logged_structure(to_xml(project_of(tree))) == [node.type for node in tree.walk()]


def logged_structure(text: str) -> list[str]:
    """The types of a tree's nodes as BehaviorTree.CPP itself wrote them into its log file's header."""
    factory = behaviortreepy.BehaviorTreeFactory()
    running = factory.create_tree_from_text(text)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tree.btlog"
        logger = behaviortreepy.FileLogger(running, str(path))
        del logger
        header = path.read_bytes().decode("utf-8", "replace")
    body = header[header.index("<BehaviorTree ") : header.index("</BehaviorTree>")]
    return re.findall(r"<(?!BehaviorTree )([A-Za-z]\w*)", body)


@examples
@given(trees(), st.integers(0, 3))
def test_import_of_what_was_exported_is_byte_for_byte(tree, seed):
    text = write_document(project_of(tree))
    if seed == 1:
        text = text.replace("\n", "\r\n")
    elif seed == 2:
        text = text.replace('"', "'") if "'" not in text and "&quot;" not in text else text
    elif seed == 3:
        text = re.sub(r' _bts_id="[^"]*"', "", text)
    project = from_xml(text, file="tree.xml")
    assert to_xml(project) == text
    assert to_xml(load(project.files)) == text


@examples
@given(trees(), st.data())
def test_an_edit_touches_one_line(tree, data):
    text = write_document(project_of(tree))
    project = from_xml(text, file="tree.xml")
    node = data.draw(st.sampled_from(list(tree.nodes)))
    edited = project.main.edited(node, comment="said otherwise")
    written = to_xml(project.with_tree(edited))
    before, after = text.split("\n"), written.split("\n")
    assert len(before) == len(after)
    changed = [pair for pair in zip(before, after, strict=True) if pair[0] != pair[1]]
    assert len(changed) <= 1
    (source,) = read_document(written, file="t.xml").trees
    assert dict(source.tree.nodes) == dict(edited.nodes)


@examples
@given(trees(), st.data())
def test_structural_edits_survive_the_file(tree, data):
    project = from_xml(write_document(project_of(tree)), file="tree.xml")
    edited = project.main
    for number in range(data.draw(st.integers(1, 3))):
        edited = random_edit(edited, data, number)
    written = to_xml(project.with_tree(edited))
    (source,) = read_document(written, file="t.xml").trees
    assert source.tree.root == edited.root
    reachable = {node.id: node for node in edited.walk()}
    assert dict(source.tree.nodes) == reachable


def random_edit(tree: Tree, data, number: int) -> Tree:
    """Adds, removes or moves a branch of the running tree."""
    ids = [node.id for node in tree.walk()]
    node = data.draw(st.sampled_from(ids))
    kind = data.draw(st.sampled_from(["insert", "remove", "move"]))
    if kind == "insert":
        from translator import Node

        return tree.inserted(Node(f"new{number}", "Fallback"), parent=node, index=0)
    if node == tree.root:
        return tree
    if kind == "remove":
        return tree.removed(node)
    below = {item.id for item in tree.walk(node)}
    target = data.draw(st.sampled_from([item for item in ids if item not in below]))
    return tree.moved(node, parent=target, index=0)


def test_self_contained_brings_the_sources_verbatim(example):
    document = read_document(self_contained(example), file="t.xml")
    assert document.code == {name: action.source for name, action in example.actions.items()}
    again = from_xml(self_contained(example), file="t.xml")
    assert {path: raw for path, raw in again.files.items() if path.startswith("actions/")} == {
        path: raw for path, raw in example.files.items() if path.startswith("actions/")
    }
    assert not [item for item in check(again) if item.is_error]


def test_marks_in_a_source_do_not_end_its_section(make_project):
    source = (
        'import py_trees\nclass X(py_trees.behaviour.Behaviour):\n    def update(self): return "]]>" "<&>"\n'
    )
    project = make_project({"n1": {"type": "X"}}, actions={"X": source})
    assert read_document(self_contained(project), file="t.xml").code["X"] == source
    assert RunningTree.from_xml(self_contained(project)).nodes[0].type == "X"


def test_same_input_gives_the_same_bytes(example):
    assert to_xml(example) == to_xml(load(dict(reversed(example.files.items()))))
    assert self_contained(example) == self_contained(load(example.files))
