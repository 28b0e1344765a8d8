"""Diagram JSON: what `restore` repairs, what it refuses, its past versions and its schema."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from hypothesis import given, settings

from tests.budget import count
from tests.translator.strategies import trees
from translator.diagram import diagram_path, diagram_text, needed_version, restore, to_diagram, version_of
from translator.migrate import CURRENT_VERSION, MIGRATIONS, PLAIN_VERSION
from translator.schema import json_schema
from translator.tree import Tree

FIXTURES = Path(__file__).parent / "fixtures"
LEAF = {"type": "AlwaysSuccess"}


def document(nodes, **more):
    made = {
        "format": "bt-studio/diagram",
        "version": 1,
        "id": "T",
        "root": "n1",
        "nodes": nodes,
        "drafts": [],
    }
    return json.dumps({**made, **more}).encode()


def found(raw):
    tree, items = restore(raw, file="trees/T.json")
    assert all(item.place.file == "trees/T.json" for item in items)
    return tree, [item.code for item in items]


REFUSED = {
    "no JSON": (b"{", "BT0001"),
    "no text": (b"\xff\xfe\x00", "BT0002"),
    "too deep": (b"[" * 100_000, "BT0001"),
    "a long number": (b'{"version": ' + b"9" * 5000 + b"}", "BT0001"),
    "a list": (b"[]", "BT0004"),
    "another format": (document({}, format="other"), "BT0005"),
    "a newer version": (document({}, version=99), "BT0006"),
    "no version": (document({}, version="one"), "BT0006"),
    "nodes as a list": (document([]), "BT0007"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_saved_is_refused(name):
    raw, code = REFUSED[name]
    assert found(raw) == (None, [code])


REPAIRED: Any = {
    "node without a type": ({"n1": LEAF, "n2": {"name": "x"}}, {}, ["BT0011"]),
    "number as a port": ({"n1": {**LEAF, "ports": {"a": 1.5}}}, {}, ["BT0012"]),
    "control character": ({"n1": {**LEAF, "name": "a\x01"}}, {}, ["BT0012"]),
    "lone surrogate": ({"n1": {**LEAF, "comment": "\ud800"}}, {}, ["BT0012"]),
    "list as a port": ({"n1": {**LEAF, "ports": {"a": []}}}, {}, ["BT0013"]),
    "ports as a list": ({"n1": {**LEAF, "ports": ["a"]}}, {}, ["BT0013"]),
    "odd position": ({"n1": {**LEAF, "position": [1, "x"]}}, {}, ["BT0013"]),
    "endless position": ({"n1": {**LEAF, "position": [1, 1e999]}}, {}, ["BT0013"]),
    "odd flag": ({"n1": {**LEAF, "disabled": "yes"}}, {}, ["BT0013"]),
    "odd children": ({"n1": {**LEAF, "children": "n2"}}, {}, ["BT0013"]),
    "unknown condition": ({"n1": {**LEAF, "conditions": {"_if": "x"}}}, {}, ["BT0014"]),
    "missing root": ({"n2": LEAF}, {}, ["BT0020", "BT0024"]),
    "root that is no text": ({"n1": LEAF}, {"root": ["n1"]}, ["BT0020", "BT0024"]),
    "missing child": ({"n1": {**LEAF, "children": ["n9"]}}, {}, ["BT0021"]),
    "second parent": (
        {"n1": {**LEAF, "children": ["n2", "n3"]}, "n2": {**LEAF, "children": ["n3"]}, "n3": LEAF},
        {},
        ["BT0022"],
    ),
    "root below a node": (
        {"n1": {**LEAF, "children": ["n2"]}, "n2": {**LEAF, "children": ["n1"]}},
        {},
        ["BT0022"],
    ),
    "ring": (
        {"n1": LEAF, "n2": {**LEAF, "children": ["n3"]}, "n3": {**LEAF, "children": ["n2"]}},
        {},
        ["BT0022", "BT0024"],
    ),
    "own child": ({"n1": {**LEAF, "children": ["n1"]}}, {}, ["BT0022"]),
    "missing draft": ({"n1": LEAF}, {"drafts": ["n9"]}, ["BT0023"]),
    "loose node": ({"n1": LEAF, "n2": LEAF}, {}, ["BT0024"]),
    "no id": ({"n1": LEAF}, {"id": None}, ["BT0010"]),
}


@pytest.mark.parametrize("name", REPAIRED)
def test_every_repair_is_made_and_reported(name):
    nodes, more, codes = REPAIRED[name]
    tree, told = found(document(nodes, **more))
    assert told == codes
    again, told = found(diagram_text(tree).encode())
    assert told == []
    assert again == tree


def test_nothing_is_lost_in_drafts():
    nodes = {"n1": LEAF, "a": {"type": "Sequence", "children": ["b"]}, "b": LEAF}
    tree, told = found(document(nodes, drafts=["a"]))
    assert told == []
    assert tree.drafts == ("a",)


def test_large_rings_and_chains_are_read_in_linear_time():
    chain = {f"n{n}": {**LEAF, "children": [f"n{n + 1}"]} for n in range(20_000)} | {"n20000": LEAF}
    tree, told = found(document(dict(reversed(chain.items())), root=None))
    assert told == ["BT0024"]
    pairs: dict[Any, Any] = {}
    for n in range(0, 20_000, 2):
        pairs |= {f"n{n}": {**LEAF, "children": [f"n{n + 1}"]}, f"n{n + 1}": {**LEAF, "children": [f"n{n}"]}}
    tree, told = found(document(pairs, root=None))
    assert len(tree.drafts) == 10_000


def test_every_past_version_has_a_migration_and_a_fixture():
    assert len(MIGRATIONS) == CURRENT_VERSION
    for version in range(CURRENT_VERSION + 1):
        raw = (FIXTURES / f"diagram_v{version}.json").read_bytes()
        tree, told = found(raw)
        assert told == []
        assert to_diagram(tree)["version"] == max(PLAIN_VERSION, version)
        assert [node.type for node in tree.walk()] == ["Sequence", "Forward"]


@settings(max_examples=count("translator_round_trip"))
@given(trees())
def test_what_is_written_is_of_the_schema(tree):
    jsonschema.validate(json.loads(json.dumps(to_diagram(tree))), json_schema("diagram"))


def test_examples_are_of_the_schemas(example):
    for path, raw in example.files.items():
        if path.startswith("trees/"):
            jsonschema.validate(json.loads(raw), json_schema("diagram"))
    jsonschema.validate(json.loads(example.files["project.json"]), json_schema("project"))


def test_autoremap_among_the_ports_is_understood():
    tree, told = found(
        document({"n1": {"type": "SubTree", "tree": "U", "ports": {"_autoremap": "1", "a": "b"}}})
    )
    assert (told, tree.nodes["n1"].autoremap, tree.nodes["n1"].ports) == ([], True, {"a": "b"})


def test_one_line_a_node():
    tree, _ = found(document({"n1": {"type": "Sequence", "children": ["n2"]}, "n2": LEAF}))
    changed = tree.edited("n2", name="x")
    pairs = zip(diagram_text(tree).split("\n"), diagram_text(changed).split("\n"), strict=True)
    assert sum(before != after for before, after in pairs) == 1


def test_paths_of_odd_ids_are_safe_and_different():
    paths = {diagram_path(name) for name in ("../up", "..\\up", "a/b", "a b", "", "a:b")}
    assert len(paths) == 6
    assert all(path.startswith("trees/") and ".." not in path and path.count("/") == 1 for path in paths)
    assert diagram_path("Größe") == "trees/Größe.json"


def test_empty_tree_is_written():
    assert found(diagram_text(Tree("T", None, {})).encode())[1] == []


def test_a_silence_is_kept_and_needs_version_2():
    silenced = {"BT0119": "it is to be replaced"}
    tree, told = found(document({"n1": {**LEAF, "silenced": silenced}}, version=2))
    assert told == []
    assert tree.nodes["n1"].silenced == silenced
    written = to_diagram(tree)
    assert (written["version"], written["nodes"]["n1"]["silenced"]) == (2, silenced)
    assert needed_version(written["nodes"].values(), 1) == 2
    assert needed_version([{}], 2) == 1
    assert needed_version([{}], 9) == 9
    assert version_of(tree.nodes.values()) == 2


def test_a_silence_that_is_no_text_is_reported():
    assert found(document({"n1": {**LEAF, "silenced": {"BT0119": []}}}, version=2))[1] == ["BT0013"]
