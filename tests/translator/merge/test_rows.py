"""Merged values."""

from __future__ import annotations

import pytest

from translator.merge.rows import choose, merge_values


@pytest.mark.parametrize(
    ("sides", "value", "conflicts"),
    [
        (("a", "a", "b"), "b", 0),
        (("a", "b", "a"), "b", 0),
        (("a", "b", "b"), "b", 0),
        (("a", None, "a"), None, 0),
        (("a", "b", "c"), "b", 1),
        (("a", None, "c"), None, 1),
        ((None, "b", "c"), "b", 1),
    ],
)
def test_one_value(sides, value, conflicts):
    found: list[object] = []
    assert choose(sides, found.append) == value
    assert found == [sides] * conflicts


def test_a_node_field_by_field():
    found: list[object] = []
    base = {"type": "A", "ports": {"p": "1", "q": "1", "gone": "1"}, "comment": "x", "children": ["c"]}
    ours = {"type": "A", "ports": {"p": "2", "q": "1"}, "name": ""}
    theirs = {"type": "B", "ports": {"p": "3", "q": "4", "gone": "1", "new": "5"}, "comment": "x"}
    merged = merge_values(base, ours, theirs, lambda *conflict: found.append(conflict))
    assert merged == {"type": "B", "ports": {"p": "2", "q": "4", "new": "5"}, "name": ""}
    assert found == [("ports.p", ("1", "2", "3"))]
