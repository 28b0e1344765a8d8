"""The operations between two versions of a tree."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.shared.make_differences import OLDER, changed, edited, grown, lucky, under_new_ids
from translator.difference import Shape, compare
from translator.difference.operations import rising

seeds = st.integers(0, 10**6)


def ops(older, newer, **options):
    return [(operation["op"], operation["node"]) for operation in compare(older, newer, **options)]


def test_a_branch_that_was_wrapped_did_not_move():
    wrapped = changed(r={"children": ["a", "b", "w", "s"]}, w={"type": "Repeat", "children": ["c"]})
    assert compare(OLDER, wrapped) == [
        {"op": "wrap", "node": "w", "type": "Repeat", "parent": "r", "index": 2, "children": ["c"]}
    ]
    assert ops(wrapped, OLDER) == [("unwrap", "w")]


def test_the_fewest_nodes_are_reordered():
    assert ops(OLDER, changed(r={"children": ["b", "c", "s", "a"]})) == [("reorder", "a")]


def test_layout_is_no_change_unless_asked_for():
    placed = {**changed(a={"position": [9, 9]}), "layout": "horizontal"}
    assert compare(OLDER, placed) == []
    found = compare(OLDER, placed, layout=True)
    assert [(operation["node"], operation["field"]) for operation in found] == [
        ("", "layout"), ("a", "position"),
    ]  # fmt: skip


def test_ids_that_mean_nothing_are_not_trusted():
    """Two files without ids are numbered when they are read: the numbers shift with the first insertion."""
    shifted = under_new_ids(changed(r={"children": ["n", "a", "b", "c", "s"]}, n={"type": "Talk"}), "")
    names = dict(zip(shifted["nodes"], [*list(shifted["nodes"])[1:], "r"], strict=True))
    newer = {
        **shifted,
        "root": names["r"],
        "drafts": [names[each] for each in shifted["drafts"]],
        "nodes": {
            names[key]: {**row, "children": [names[child] for child in row["children"]]}
            for key, row in shifted["nodes"].items()
        },
    }
    assert ops(OLDER, newer, ids=()) == [("insert", names["n"])]
    assert len(ops(OLDER, newer)) > 1


@given(seeds)
def test_a_tree_and_itself_do_not_differ(seed):
    tree = grown(lucky(seed), 12)
    assert compare(tree, tree, layout=True) == []
    assert compare(tree, under_new_ids(tree, "x"), ids=()) == []


@given(seeds, st.booleans())
def test_what_both_versions_have_and_no_operation_names_is_equal(seed, renamed):
    luck = lucky(seed)
    older = grown(luck, 12)
    edit = edited(luck, older, 4)
    newer = under_new_ids(edit, "x") if renamed else edit
    found = compare(older, newer)
    named = {operation["node"] for operation in found}
    one, other = Shape(older), Shape(newer)
    gone = {operation["node"] for operation in found if operation["op"] in {"delete", "unwrap"}}
    new = {operation["node"] for operation in found if operation["op"] in {"insert", "wrap"}}
    assert len(one.rows) - len(gone) == len(other.rows) - len(new)
    if not renamed:
        for node_id in (set(newer["nodes"]) & set(older["nodes"])) - named:
            assert older["nodes"][node_id].get("ports") == newer["nodes"][node_id].get("ports")


@given(st.permutations(range(9)))
def test_rising_is_rising_and_longest(ranks):
    places = sorted(rising(ranks))
    kept = [ranks[place] for place in places]
    assert kept == sorted(kept)
    best = [1] * len(ranks)
    for place, rank in enumerate(ranks):
        best[place] += max((best[before] for before in range(place) if ranks[before] < rank), default=0)
    assert len(places) == max(best)


@pytest.mark.parametrize(
    "operation", compare(OLDER, changed(b=None, d=None, r={"children": ["a", "c", "s"]}))
)
def test_a_deleted_branch_is_named_node_by_node(operation):
    assert operation["op"] == "delete"
    assert operation["parent"] in OLDER["nodes"]
