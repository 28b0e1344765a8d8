"""Versions without ids of their own."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from tests.shared.make_differences import OLDER, changed, edited, grown, lucky, under_new_ids
from translator.difference import compare
from translator.merge.align import align
from translator.merge.trees import merge_documents


def test_partners_have_our_ids():
    ours = under_new_ids(changed(a={"ports": {"speed": "9"}}), "o")
    base, theirs = align(under_new_ids(OLDER, "b"), ours, under_new_ids(changed(c={"name": "x"}), "t"), ())
    merged = merge_documents(base, ours, theirs)
    assert merged.conflicts == ()
    assert merged.document["nodes"]["oa"]["ports"] == {"speed": "9"}
    assert merged.document["nodes"]["oc"]["name"] == "x"


def test_the_same_insertion_on_both_sides_is_one():
    inserted = changed(r={"children": ["a", "n", "b", "c", "s"]}, n={"type": "Talk"})
    base, theirs = align(under_new_ids(OLDER, "b"), inserted, under_new_ids(inserted, "t"), ())
    merged = merge_documents(base, inserted, theirs)
    assert compare(inserted, merged.document) == []


@given(st.integers(0, 10**9))
def test_no_two_nodes_get_one_id(seed):
    luck = lucky(seed)
    base = grown(luck, 10)
    ours, theirs = (edited(luck, base, 4) for _ in range(2))
    for ids in ((), base["nodes"].keys()):
        sides = align(base, ours, theirs, ids)
        assert [len(each["nodes"]) for each in sides] == [len(base["nodes"]), len(theirs["nodes"])]
