"""The picture of both versions."""

from __future__ import annotations

from lxml import etree

from tests.shared.make_differences import OLDER, changed, diagram, under_new_ids
from translator.difference.picture import picture
from translator.difference.projects import Version, compare_versions

SVG = "{http://www.w3.org/2000/svg}"


def drawn(older, newer, ids=None):
    one, other = (Version("", {each["id"]: each}, ids=ids) for each in (older, newer))
    return etree.fromstring(picture(compare_versions(one, other).trees).encode())


def blocks(root):
    """The tooltip and the words of each block."""
    return {group[0].text: [each.text for each in group.iter(f"{SVG}text")] for group in root.iter(f"{SVG}g")}


def test_changed_removed_and_new_blocks_are_marked():
    newer = changed(
        a={"ports": {"speed": "0.3", "gone": "x"}},
        r={"children": ["a", "b", "s", "n"]},
        n={"type": "Talk"},
        c=None,
    )
    found = blocks(drawn(OLDER, newer))
    assert found["Forward [a]"] == ["Forward", "speed: 0.2 → 0.3", "≠"]
    assert found["left (Turn) [c]"][-1] == "−"
    assert found["Talk [n]"][-1] == "+"


def test_branches_without_a_change_are_folded():
    found = blocks(drawn(OLDER, changed(a={"name": "x"})))
    assert found["rescue (Fallback) [s]"][-1] == "… 2 below, equal"
    assert "Forward [e]" not in found


def test_no_block_lies_on_another():
    newer = under_new_ids(changed(s={"children": ["f", "e"]}, r={"children": ["c", "a", "b", "s"]}), "x")
    for ids in (None, frozenset[str]()):
        root = drawn(OLDER, newer, ids)
        rects = list(root.iter(f"{SVG}rect"))[1:]
        places = [[float(rect.get(key)) for key in ("x", "y", "width", "height")] for rect in rects]
        assert places
        for one in places:
            for other in places:
                apart = one[0] + one[2] <= other[0] or one[1] + one[3] <= other[1]
                assert one is other or apart or other[0] + other[2] <= one[0] or other[1] + other[3] <= one[1]


def test_a_deep_chain_is_drawn():
    nodes = {f"n{k}": {"type": "Inverter", "children": [f"n{k + 1}"]} for k in range(3000)}
    chain = diagram({**nodes, "n3000": {"type": "AlwaysSuccess"}}, root="n0")
    other = {**chain, "nodes": {**chain["nodes"], "n3000": {"type": "AlwaysFailure"}}}
    assert len(blocks(drawn(chain, other))) == 3001


def test_foreign_text_is_text():
    hostile = '</text><script>alert(1)</script><img src=x onerror="x">'
    root = drawn(OLDER, changed(a={"name": hostile, "ports": {hostile: hostile}}))
    assert not [each for each in root.iter() if each.tag not in {f"{SVG}{name}" for name in
                ("svg", "g", "rect", "path", "text", "circle", "title")}]  # fmt: skip


def test_nothing_differs():
    assert "No tree differs." in picture([])
