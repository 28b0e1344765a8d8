"""A tree of another program becomes diagrams, whose blocks its nodes name."""

from __future__ import annotations

import copy
import json
import random
from typing import Final
from xml.etree import ElementTree as ET
from xml.sax.saxutils import quoteattr

import pytest

from executor.attached.document import document_of
from tests.budget import seeds
from tests.tree_gardener.groot.cpp_program import XML
from translator.diagnostic import TranslatorError
from translator.importer import from_xml
from tree_gardener import Tree
from tree_gardener.groot import GrootError
from tree_gardener.groot.document import document_of as published
from tree_gardener.groot.remote import read_tree


def test_instances_that_are_alike_have_one_diagram() -> None:
    found = document_of(read_tree(bytes(16), published(Tree.from_xml(XML))))
    assert sorted(path for path in found.files if path.startswith("trees/")) == [
        "trees/Main.json",
        "trees/Sub.json",
    ]
    assert found.main_tree == "Main"
    blocks = [(node.uid, node.parent, node.tree_id, node.node_id) for node in found.nodes]
    assert blocks[3:5] == [(4, 3, "Sub", "u4"), (5, 4, "Sub", "u5")]
    assert blocks[6:8] == [(7, 6, "Sub", "u4"), (8, 7, "Sub", "u5")]
    rows = json.loads(found.files["trees/Main.json"])["nodes"]
    assert rows["u3"] == {"type": "SubTree", "tree": "Sub", "name": "mine", "ports": {"x": "{a}"}}
    assert [node.kind for node in found.nodes][:4] == ["Control", "Action", "SubTree", "Decorator"]


def test_the_xml_is_imported_as_the_same_project() -> None:
    found = document_of(read_tree(bytes(16), published(Tree.from_xml(XML))))
    project = from_xml(found.xml)
    assert {path: data for path, data in project.files.items() if path.startswith("trees/")} == {
        path: data for path, data in found.files.items() if path.startswith("trees/")
    }


def document(*trees: str, models: str = "") -> bytes:
    return f'<root BTCPP_format="4">{"".join(trees)}<TreeNodesModel>{models}</TreeNodesModel></root>'.encode()


def tree(tree_id: str, path: str, inner: str) -> str:
    return f"<BehaviorTree ID={quoteattr(tree_id)} _fullpath={quoteattr(path)}>{inner}</BehaviorTree>"


def test_instances_of_one_id_that_differ_have_diagrams_of_their_own() -> None:
    found = document_of(
        read_tree(
            bytes(16),
            document(
                tree(
                    "Main",
                    "",
                    '<Sequence _uid="11"><SubTree ID="S" _fullpath="a" _uid="12"/>'
                    '<SubTree ID="S" _fullpath="b" _uid="14"/></Sequence>',
                ),
                tree("S", "a", '<AlwaysSuccess _uid="13"/>'),
                tree("S", "b", '<AlwaysFailure _uid="15"/>'),
            ),
        )
    )
    assert [(node.uid, node.tree_id) for node in found.nodes] == [
        (1, "Main"),
        (2, "Main"),
        (3, "S"),
        (4, "Main"),
        (5, "S_2"),
    ]
    assert found.numbers == {11: 1, 12: 2, 13: 3, 14: 4, 15: 5}


def test_nodes_of_the_program_have_their_models() -> None:
    models = '<Action ID="Fly"><input_port name="height" type="double">In m</input_port></Action>'
    remote = read_tree(bytes(16), document(tree("Main", "", '<Fly _uid="1" height="2"/>'), models=models))
    found = document_of(remote)
    assert [action["name"] for action in found.actions] == ["Fly"]
    assert found.nodes[0].kind == "Action"


def test_two_nodes_of_one_uid_are_refused() -> None:
    two = '<Sequence _uid="1"><AlwaysSuccess _uid="2"/><AlwaysFailure _uid="2"/></Sequence>'
    with pytest.raises(GrootError, match="same uid"):
        document_of(read_tree(bytes(16), document(tree("Main", "", two))))


TEXTS: Final = (
    "",
    "0",
    "65535",
    "65536",
    "-1",
    "1e3",
    "\u0663",
    "a/b",
    "../x",
    "{a",
    "Main",
    "x" * 300,
    "<&>",
)
TAGS: Final = (
    "BehaviorTree",
    "SubTree",
    "Sequence",
    "Fallback",
    "AlwaysSuccess",
    "TreeNodesModel",
    "root",
    "_",
)


def test_a_changed_document_is_shown_or_refused_with_a_reason() -> None:
    sound = published(Tree.from_xml(XML))
    shown = refused = 0
    today = seeds("groot_hostile_trees")
    for seed in today:
        data = changed(sound, random.Random(seed))  # noqa: S311 - reproducible, no secret
        try:
            remote = read_tree(bytes(16), data)
            found = document_of(remote)
        except (GrootError, TranslatorError) as error:
            refused += bool(str(error))
        else:
            shown += 1
            assert [node.path for node in found.nodes] == [node.path for node in remote.nodes], seed
            diagrams = [json.loads(data) for path, data in found.files.items() if path.startswith("trees/")]
            blocks = {(each["id"], block) for each in diagrams for block in each["nodes"]}
            assert {(node.tree_id, node.node_id) for node in found.nodes} <= blocks, seed
    assert min(shown, refused) > 5
    assert shown + refused == len(today), "each refusal has its reason"


def changed(sound: bytes, chance: random.Random) -> bytes:
    """Returns a document of which some elements, attributes or bytes are others."""
    if chance.random() < 0.2:
        data = bytearray(sound)
        for _ in range(chance.choice((1, 1, 4))):
            at = chance.randrange(len(data))
            data[at : at + chance.choice((0, 1, 8, 99))] = chance.choice((b"", b"<", b'"', b"\xff", b"&a;"))
        return bytes(data)
    root = ET.fromstring(sound)  # noqa: S314 - our own
    for _ in range(chance.choice((1, 1, 2, 5))):
        change(root, chance)
    return ET.tostring(root)


def change(root: ET.Element, chance: random.Random) -> None:
    """Changes one element, its attributes or its place."""
    every = list(root.iter())
    one, other = chance.choice(every), chance.choice(every)
    match chance.randrange(6):
        case 0:
            other.insert(chance.randrange(len(other) + 1), copy.deepcopy(one))
        case 1 if len(other):
            other.remove(chance.choice(list(other)))
        case 2:
            one.tag = chance.choice((*TAGS, other.tag))
        case 3 if other.attrib:
            name = chance.choice(list(other.attrib))
            one.set(name, chance.choice((*TEXTS, other.get(name, ""))))
        case 4 if one.attrib:
            del one.attrib[chance.choice(list(one.attrib))]
        case _:
            one.text = chance.choice(TEXTS)
