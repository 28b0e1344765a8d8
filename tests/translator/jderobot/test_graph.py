"""Graphs of JdeRobot's BT Studio: every row and oddity of the format."""

from __future__ import annotations

import json

import pytest

from tests.fakes.react_diagrams import ROOT, Graph, chain
from translator.jderobot.graph import GraphOptions, read_graph


def read(graph, *, bottom_to_top=True, subtrees=None):
    raw = graph if isinstance(graph, bytes) else graph.to_bytes()
    return read_graph(raw, GraphOptions("MainTree", "graph.json", bottom_to_top, subtrees or {}))


def shape(tree, node_id=None):
    node = tree.nodes[node_id or tree.root]
    return [node.tree or node.type, dict(node.ports), [shape(tree, child) for child in node.children]]


def wide(*, backwards=False, old=False, heights=(10, 30, 20)):
    graph = Graph(old_port_types=old)
    graph.node("root", ROOT)
    graph.node("s", "Sequence")
    graph.join("root", "s", backwards=backwards)
    for name, y in zip("abc", heights, strict=True):
        graph.node(name, name.upper(), y)
        graph.join("s", name, backwards=backwards)
    return graph


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize("old", [False, True])
def test_links_in_either_direction_and_old_port_types(backwards, old):
    tree, found = read(wide(backwards=backwards, old=old))
    assert found == ()
    assert shape(tree) == ["Sequence", {}, [["B", {}, []], ["C", {}, []], ["A", {}, []]]]


def test_order_from_top_to_bottom():
    tree, _ = read(wide(), bottom_to_top=False)
    assert [tree.nodes[child].type for child in tree.nodes["s"].children] == ["A", "C", "B"]


def test_ties_keep_the_order_of_the_links():
    for bottom_to_top in (True, False):
        tree, _ = read(wide(heights=(5, 5, 5)), bottom_to_top=bottom_to_top)
        assert [tree.nodes[child].type for child in tree.nodes["s"].children] == ["A", "B", "C"]


@pytest.mark.parametrize("backwards", [False, True])
def test_tags_are_values_of_ports(backwards):
    graph = chain("Detect")
    graph.node("b0", "Detect", ports={"speed": "input", "pos": "output"})
    graph.feed(graph.tag("t1", "0.5"), "b0", "speed", backwards=backwards)
    graph.feed(graph.tag("t2", "{pos}", writes=True), "b0", "pos", backwards=backwards)
    tree, found = read(graph)
    assert found == ()
    assert tree.nodes["b0"].ports == {"speed": "0.5", "pos": "{pos}"}


def test_port_without_a_value_is_left_out():
    graph = chain("Detect")
    graph.node("b0", "Detect", ports={"speed": "input"})
    assert read(graph)[0].nodes["b0"].ports == {}


def test_delay_is_renamed():
    graph = chain("Delay", "A")
    graph.node("b0", "Delay", ports={"delay_ms": "input"})
    graph.feed(graph.tag("t", "100"), "b0", "delay_ms")
    assert read(graph)[0].nodes["b0"].ports == {"delay_msec": "100"}


@pytest.mark.parametrize("flag", [{}, {"is_subtree": False}, {"is_subtree": True}])
def test_subtree_by_its_file_or_its_flag(flag):
    graph = chain("Sequence")
    graph.node("x", "Patrol", **flag)
    graph.join("b0", "x")
    tree, _ = read(graph, subtrees={"Patrol": "Patrol"})
    node = tree.nodes["x"]
    assert (node.type, node.tree, node.autoremap) == ("SubTree", "Patrol", True)


def test_dangling_links_and_orphans():
    graph = wide()
    graph.link("a.children", None)
    graph.link("nobody.children", "b.parent")
    graph.node("lost", "Fallback")
    graph.node("below", "D")
    graph.join("lost", "below")
    tree, found = read(graph)
    assert tree.drafts == ("lost",)
    assert [item.code for item in found] == ["BT0804", "BT0804", "BT0024"]
    assert all(item.place.file == "graph.json" for item in found)


def test_link_without_a_meaning():
    graph = wide()
    graph.link("a.parent", "b.parent")
    assert [item.code for item in read(graph)[1]] == ["BT0803"]


def test_second_parent_and_ring():
    graph = wide()
    graph.join("a", "b")
    graph.join("a", "s")
    tree, found = read(graph)
    assert [item.code for item in found] == ["BT0022", "BT0022"]
    assert len(list(tree.walk())) == 4


def test_two_values_for_one_port():
    graph = chain("Move")
    graph.node("b0", "Move", ports={"speed": "input"})
    graph.feed(graph.tag("t1", "1"), "b0", "speed")
    graph.feed(graph.tag("t2", "2"), "b0", "speed")
    tree, found = read(graph)
    assert tree.nodes["b0"].ports == {"speed": "1"}
    assert [item.code for item in found] == ["BT0805"]


def test_root_with_several_children_and_none():
    graph = Graph()
    graph.node("root", ROOT)
    graph.node("a", "A", 1)
    graph.node("b", "B", 2)
    graph.join("root", "a")
    graph.join("root", "b")
    tree, found = read(graph)
    assert (tree.root, tree.drafts) == ("b", ("a",))
    assert [item.code for item in found] == ["BT0807"]
    headless = wide()
    del headless.blocks["root"]
    headless.links.pop("link0")
    tree, found = read(headless)
    assert tree.root == "s"
    assert [item.code for item in found] == ["BT0806"]


@pytest.mark.parametrize(
    "raw", [b"", b"[]", b"{}", b'{"layers": 5}', b'{"layers": [{"models": null}]}', b"\xff"]
)
def test_what_is_no_graph_is_refused_with_a_place(raw):
    tree, found = read(raw)
    assert tree is None
    assert found[0].place.file == "graph.json"


def test_odd_values_do_not_stop_the_reading():
    document = wide().document()
    document["layers"][1]["models"]["s"]["y"] = "high"
    document["layers"][1]["models"]["a"]["ports"].append("junk")
    document["layers"][1]["models"]["junk"] = {"id": 5}
    document["layers"].append("junk")
    tree, found = read(json.dumps(document).encode())
    assert len(list(tree.walk())) == 4
    assert [item.code for item in found] == ["BT0802"]
