"""Sets of results, and the literals of ports."""

from __future__ import annotations

import pytest

from translator.check.results.sets import (
    ALL,
    YIELDS,
    F,
    K,
    R,
    S,
    literal,
    names_of,
    set_of,
    whole,
    words,
)
from translator.tree import Node


def test_names_and_sets_belong_together():
    assert names_of(ALL) == ["SUCCESS", "FAILURE", "RUNNING", "SKIPPED"]
    assert set_of(names_of(F | K)) == F | K
    assert set_of({"OTHER"}) == 0


def test_a_yield_is_a_running():
    assert names_of(YIELDS) == ["RUNNING"]
    assert words(S | YIELDS) == "succeeds or runs"
    assert words(0) == "never ends"


@pytest.mark.parametrize(
    ("text", "number"), [("5", 5), ("-1", -1), ("12abc", 12), ("", None), ("{n}", None), ("x", None)]
)
def test_numbers_are_read_as_the_engine_reads_them(text, number):
    assert whole(Node("n", "Repeat", ports={"num_cycles": text}), "num_cycles") == number


def test_defaults_hold_where_nothing_is_given():
    node = Node("n", "Parallel")
    assert whole(node, "success_count", -1) == -1
    assert whole(node, "success_count") is None
    assert literal(node, "a") is None
    assert literal(Node("n", "X", ports={"a": "{b}"}), "a", "c") is None
    assert (R, S) == (4, 1)
