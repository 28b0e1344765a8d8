"""Lines of files lead to blocks, and back."""

from __future__ import annotations

import pytest

from executor.headless.dap.lines import Lines, NoBlockError
from tree_gardener import Tree
from tree_gardener.debugging import place_of

XML = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main">
  <Sequence _bts_id="a">
    <SubTree ID="Sub"
             name="x > y" _bts_id="b"/>

    <Action ID="AlwaysSuccess" _bts_id="c"/>
    <SubTree ID="Sub" _bts_id="d"/>
  </Sequence>
</BehaviorTree>
<BehaviorTree ID="Sub"><AlwaysSuccess _bts_id="e"/></BehaviorTree>
</root>"""
DIAGRAM = """{
  "format": "bt-studio/diagram", "id": "Main", "root": "a",
  "comment": "nodes {",
  "nodes": {
    "a": {"type": "Sequence", "children": ["b", "c", "d"]},
    "b": {
      "type": "SubTree", "ports": {"ID": "Sub }"}
    },
    "c": {"type": "AlwaysSuccess"}, "d": {"type": "SubTree"}
  },
  "drafts": [{"nodes": {"a": {"type": "Sequence"}}}]
}"""


@pytest.fixture(scope="module")
def tree() -> Tree:
    return Tree.from_xml(XML)


def test_lines_of_xml(tree: Tree) -> None:
    lines = Lines({"t.xml": XML.encode()}, tree.nodes)
    found = [lines.block("t.xml", line) for line in (1, 3, 4, 5, 6, 7, 9)]
    assert [block.place.key for block in found] == ["a", "a", "b", "b", "c", "c", "e"]
    assert [block.first for block in found] == [3, 3, 4, 4, 7, 7, 11]
    assert [lines.line(node) for node in tree.nodes] == [("t.xml", line) for line in (3, 4, 11, 7, 8, 11)]
    with pytest.raises(NoBlockError, match="no block in this line or below"):
        lines.block("t.xml", 12)


def test_lines_of_a_diagram(tree: Tree) -> None:
    lines = Lines({"trees/Main.json": DIAGRAM.encode()}, tree.nodes)
    found = [lines.block("trees/Main.json", line) for line in (1, 5, 6, 7, 8, 9)]
    assert [block.place.key for block in found] == ["a", "a", "b", "b", "b", "c"]
    assert all(block.place.tree_id == "Main" for block in found)
    assert lines.line(tree.nodes[2]) is None, "the file of Sub is not there"
    assert found[2].place == place_of(tree.nodes[1])


@pytest.mark.parametrize(
    ("path", "data", "why"),
    [
        ("a.json", b"{", "cannot be read|can be read"),
        ("a.json", b"[]", "no diagram"),
        ("a.json", b'{"format": "bt-studio/diagram", "id": "Other", "nodes": {}}', "Other is not part"),
        ("a.json", b'{"format": "bt-studio/diagram", "id": "Main", "nodes": []}', "no block in this line"),
        ("a.json", b"\xff", "can be read"),
        ("a.json", b'{"a":' * 5000, "can be read"),
        ("a.xml", b"<root>", "can be read"),
        ("a.xml", b"<root><BehaviorTree ID='X'/></root>", "no tree that runs"),
        ("a.xml", b"<root><BehaviorTree ID='Main'><Sequence/></BehaviorTree></root>", "are not those"),
        ("a.txt", b"", "no tree of this project"),
        ("a.py", b"", "no tree of this project; breakpoints in Python are set in the page"),
    ],
)
def test_a_file_without_blocks_says_why(tree: Tree, path: str, data: bytes, why: str) -> None:
    with pytest.raises(NoBlockError, match=why):
        Lines({path: data}, tree.nodes).block(path, 1)
