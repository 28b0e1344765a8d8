"""Which node of one version is which of the other."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from tests.shared.make_differences import OLDER, changed, diagram, edited, grown, lucky, under_new_ids
from translator.difference.match import match
from translator.difference.shape import Shape


def pairs(older, newer, **options):
    return match(Shape(older), Shape(newer), **options)


def test_an_id_decides_whatever_the_node_says():
    newer = changed(a={"type": "Talk", "ports": {}})
    assert pairs(OLDER, newer) == {key: key for key in OLDER["nodes"]}


def test_without_ids_equal_branches_then_similar_ones_then_their_children():
    newer = under_new_ids(changed(e={"ports": {"speed": "9"}}, r={"children": ["s", "a", "b", "c"]}), "x")
    assert pairs(OLDER, newer) == {key: f"x{key}" for key in OLDER["nodes"]}


def test_a_similar_branch_needs_more_than_half_of_its_descendants():
    older = diagram(
        {
            "r": {"type": "Sequence", "children": ["s"]},
            "s": {"type": "Fallback", "children": ["a", "b"]},
            "a": {"type": "Inverter", "children": ["c"]},
            "b": {"type": "Talk"},
            "c": {"type": "IsNear"},
        }
    )
    newer = diagram({"q": {"type": "Parallel", "children": ["t", "d"]},
                     "t": {"type": "Fallback", "children": ["u"]},
                     "u": {"type": "Inverter", "children": ["v"]}, "v": {"type": "IsNear"},
                     "d": {"type": "Delay"}}, root="q")  # fmt: skip
    assert pairs(older, newer) == {"a": "u", "c": "v", "s": "t"}


@given(st.integers(0, 10**6))
def test_no_node_has_two_partners(seed):
    luck = lucky(seed)
    older = grown(luck, 15)
    found = pairs(older, under_new_ids(edited(luck, older, 5), "x"))
    assert len(set(found.values())) == len(found)
    assert set(found) <= set(older["nodes"])
