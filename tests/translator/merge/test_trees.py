"""Three-way merges of trees: what must hold for all edits, and the conflicts one by one."""

from __future__ import annotations

from copy import deepcopy

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.budget import count
from tests.shared.make_differences import OLDER, changed, edited, grown, lucky
from translator.difference import Shape, compare
from translator.difference.shape import fields
from translator.merge.trees import merge_documents, renamed

seeds = st.integers(0, 10**9)
EDITS = 6
PAIRS = count("merge_pairs")


def three(seed):
    """A tree and two edits of it, with new nodes under ids of their own."""
    luck = lucky(seed)
    base = grown(luck, luck.randrange(1, 14))
    ours = edited(luck, base, luck.randrange(EDITS), mark="o")
    theirs = edited(luck, base, luck.randrange(EDITS), mark="t")
    return base, ours, theirs


def placed(conflicts):
    return [(each["op"], each["node"]) for each in conflicts]


def assert_sound(document):
    """Every node once, below the root or in the drafts."""
    shape = Shape(document)
    assert sorted(shape.order) == sorted(document["nodes"])
    assert len(set(shape.order)) == len(shape.order)


@given(seeds)
@example(39218)  # a node that ours deleted and theirs put elsewhere, where ours has changed the order
@settings(max_examples=PAIRS)
def test_no_edit_of_either_side_is_lost_without_a_conflict(seed):
    base, ours, theirs = three(seed)
    merged = merge_documents(base, ours, theirs)
    assert_sound(merged.document)
    result, before = Shape(merged.document), Shape(base)
    named = {each["node"] for each in merged.conflicts}
    for side, other in ((Shape(ours), theirs), (Shape(theirs), ours)):
        for node in set(side.order) - named:
            old, now = fields(before.rows.get(node, {})), fields(side.rows[node])
            is_moved = side.parents[node] != before.parents.get(node, "new")
            if node not in result.rows:  # the other side's deletion, of what this side left alone
                assert node in before.rows
                assert node not in other["nodes"]
                assert (old, is_moved) == (now, False)
                continue
            for key in {*old, *now}:
                if old.get(key) != now.get(key):
                    assert fields(result.rows[node]).get(key) == now.get(key)
            if is_moved:
                assert result.parents[node] == side.parents[node]
        assert not (before.rows.keys() - side.rows.keys() - named) & result.rows.keys()
        assert_orders_kept(before, side, result, named)


def assert_orders_kept(before, side, result, named):
    """Two siblings that a side exchanged are exchanged in the result, if they still are siblings."""
    for parent in (side.rows.keys() & before.rows.keys() & result.rows.keys()) - named:
        old, now, kept = (shape.children(parent) for shape in (before, side, result))
        stayed = [each for each in now if each in old and each in kept]
        for place, one in enumerate(stayed):
            for other in stayed[place + 1 :]:
                if old.index(one) > old.index(other):
                    assert kept.index(one) < kept.index(other)


@given(seeds)
@settings(max_examples=PAIRS)
def test_a_side_that_changed_nothing_takes_the_other(seed):
    base, ours, _ = three(seed)
    for sides in ((base, base, ours), (base, ours, base), (base, ours, ours)):
        merged = merge_documents(*sides)
        assert merged.conflicts == ()
        assert compare(ours, merged.document, layout=True) == []


@given(seeds)
@settings(max_examples=PAIRS)
def test_both_orders_are_equal_but_for_insertions_at_one_place(seed):
    base, ours, theirs = three(seed)
    one, other = merge_documents(base, ours, theirs), merge_documents(base, theirs, ours)
    assert bool(one.conflicts) == bool(other.conflicts)
    if one.conflicts:
        return
    left, right = Shape(one.document), Shape(other.document)
    assert left.rows.keys() == right.rows.keys()
    for node, row in left.rows.items():
        assert fields(row) == fields(right.rows[node])
        assert left.parents[node] == right.parents[node]
        before = base["nodes"].get(node, {}).get("children", [])
        stayed = [each for each in left.children(node) if each in before]
        assert stayed == [each for each in right.children(node) if each in before]


def test_edits_of_both_sides_come_together():
    ours = changed(
        a={"ports": {"speed": "0.2"}},
        r={"children": ["a", "w", "c", "s"]},
        w={"type": "Repeat", "children": ["b"]},
    )
    theirs = changed(
        a={"ports": {"speed": "0.5", "gone": "x"}}, c={"name": "right"}, r={"children": ["s", "a", "b", "c"]}
    )
    merged = merge_documents(OLDER, ours, theirs)
    assert merged.conflicts == ()
    assert merged.document["nodes"]["r"]["children"] == ["s", "a", "w", "c"]
    assert merged.document["nodes"]["a"]["ports"] == {"speed": "0.5"}
    assert merged.document["nodes"]["c"]["name"] == "right"
    assert "conflicts" not in merged.document


def test_a_wrapper_goes_where_the_other_side_moved_what_it_is_around():
    ours = changed(r={"children": ["w", "b", "c", "s"]}, w={"type": "Repeat", "children": ["a"]})
    theirs = changed(r={"children": ["b", "c", "s", "a"]})
    for sides in ((ours, theirs), (theirs, ours)):
        merged = merge_documents(OLDER, *sides)
        assert merged.conflicts == ()
        assert merged.document["nodes"]["r"]["children"] == ["b", "c", "s", "w"]


def test_what_was_unwrapped_goes_where_the_other_side_moved_its_wrapper():
    ours = changed(r={"children": ["a", "d", "c", "s"]}, b=None)
    theirs = changed(r={"children": ["b", "a", "c", "s"]})
    for sides in ((ours, theirs), (theirs, ours)):
        assert merge_documents(OLDER, *sides).document["nodes"]["r"]["children"] == ["d", "a", "c", "s"]


INSERTED = changed(r={"children": ["a", "n", "b", "c", "s"]}, n={"type": "Talk", "name": "one"})
CASES = {
    "field": (changed(a={"ports": {"speed": "1"}}), changed(a={"ports": {"speed": "2"}}), ("change", "a")),
    "name": (changed(c={"name": "x"}), changed(c={"name": "y"}), ("rename", "c")),
    "parent": (
        changed(r={"children": ["a", "b", "s"]}, s={"children": ["e", "f", "c"]}),
        changed(r={"children": ["a", "b", "s"]}, b={"children": ["d", "c"]}),
        ("move", "c"),
    ),
    "order": (
        changed(r={"children": ["s", "a", "b", "c"]}),
        changed(r={"children": ["b", "a", "c", "s"]}),
        ("reorder", "r"),
    ),
    "deleted and changed": (
        changed(r={"children": ["b", "c", "s"]}, a=None),
        changed(a={"ports": {"speed": "9", "gone": "x"}}),
        ("delete", "a"),
    ),
    "moved into something deleted": (
        changed(r={"children": ["a", "b", "c"]}, s=None, e=None, f=None),
        changed(r={"children": ["a", "b", "s"]}, s={"children": ["e", "f", "c"]}),
        ("delete", "s"),
    ),
    "ring": (
        changed(r={"children": ["a", "b", "c"]}, b={"type": "Fallback", "children": ["d", "s"]}),
        changed(r={"children": ["a", "c", "s"]}, s={"children": ["e", "f", "b"]}),
        ("ring", "b"),
    ),
    "children": (
        changed(b={"children": ["g"]}, d=None, g={"type": "Talk"}),
        changed(b={"children": ["h"]}, d=None, h={"type": "Talk"}),
        ("children", "b"),
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_each_conflict(case):
    ours, theirs, expected = CASES[case]
    merged = merge_documents(OLDER, ours, theirs)
    assert expected in placed(merged.conflicts)
    assert merged.document["conflicts"] == list(merged.conflicts)
    assert {"base", "ours", "theirs"} <= set(merged.conflicts[0])
    assert_sound(merged.document)
    assert merge_documents(OLDER, theirs, ours).conflicts


def test_what_one_side_deleted_and_the_other_changed_stays_until_it_is_decided():
    ours, theirs, _ = CASES["moved into something deleted"]
    merged = merge_documents(OLDER, ours, theirs)
    assert merged.document["nodes"]["s"]["children"] == ["c"]
    assert merged.conflicts[0]["ours"] is None


def test_two_roots():
    ours = {**changed(o={"type": "Inverter"}), "root": "o", "drafts": ["z", "r"]}
    theirs = {**changed(t={"type": "Inverter", "children": ["r"]}), "root": "t"}
    merged = merge_documents(OLDER, ours, theirs)
    assert ("root", "t") in placed(merged.conflicts)
    assert merged.document["root"] == "o"
    assert_sound(merged.document)


def test_one_id_for_different_nodes_gives_the_second_a_new_one():
    theirs = changed(
        s={"children": ["e", "n", "f"]}, n={"type": "Wait", "children": ["m"]}, m={"type": "Talk"}
    )
    merged = merge_documents(OLDER, INSERTED, theirs)
    assert merged.conflicts == ()
    assert merged.document["nodes"]["n"]["type"] == "Talk"
    assert merged.document["nodes"]["s"]["children"] == ["e", "n_2", "f"]
    assert merged.document["nodes"]["n_2"] == {"type": "Wait", "children": ["m"]}


def test_the_same_node_that_both_sides_have_already_is_one():
    further = deepcopy(INSERTED)
    further["nodes"]["n"]["ports"] = {"text": "hi"}
    merged = merge_documents(OLDER, INSERTED, further)
    assert merged.conflicts == ()
    assert merged.document["nodes"]["n"]["ports"] == {"text": "hi"}


def test_insertions_at_one_place_ours_first():
    theirs = changed(r={"children": ["a", "m", "b", "c", "s"]}, m={"type": "Talk", "name": "two"})
    merged = merge_documents(OLDER, INSERTED, theirs)
    assert merged.document["nodes"]["r"]["children"] == ["a", "n", "m", "b", "c", "s"]


def test_layout_never_conflicts():
    merged = merge_documents(OLDER, changed(a={"position": [5, 5]}), changed(a={"position": [6, 6]}))
    assert merged.conflicts == ()
    assert merged.document["nodes"]["a"]["position"] == [5, 5]


def test_conflicts_that_are_there_already_stay():
    ours = {**INSERTED, "conflicts": [{"op": "change", "node": "a"}]}
    merged = merge_documents(OLDER, ours, changed(c={"name": "x"}))
    assert merged.conflicts == ({"op": "change", "node": "a"},)


def test_ports_and_attributes_of_the_tree():
    ports = [{"name": name, "direction": "input"} for name in "pqr"]
    base = {**OLDER, "ports": ports[:1], "attributes": {"_a": "1"}}
    ours = {**base, "ports": ports[:2]}
    theirs = {**base, "ports": [ports[0], ports[2]], "attributes": {}, "later": [1]}
    merged = merge_documents(base, ours, theirs)
    assert [port["name"] for port in merged.document["ports"]] == ["p", "q", "r"]
    assert "attributes" not in merged.document
    assert merged.document["later"] == [1]


def test_ids_are_replaced_everywhere():
    document = renamed(OLDER, {"r": "R", "a": "A", "z": "Z"})
    assert (document["root"], document["drafts"]) == ("R", ["Z"])
    assert document["nodes"]["R"]["children"] == ["A", "b", "c", "s"]
