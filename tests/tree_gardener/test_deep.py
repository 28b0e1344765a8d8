"""Calls that recurse deeper than Python allows by itself."""

from __future__ import annotations

import sys

import pytest

from tree_gardener.deep import call_deep


def deep(levels: int) -> int:
    return 0 if levels == 0 else 1 + deep(levels - 1)


def test_a_deep_call_returns_and_the_limit_is_as_before() -> None:
    before = sys.getrecursionlimit()
    assert call_deep(lambda: deep(2 * before), 2 * before) == 2 * before
    assert sys.getrecursionlimit() == before


def test_an_error_comes_out_and_the_limit_is_as_before() -> None:
    before = sys.getrecursionlimit()
    with pytest.raises(ZeroDivisionError):
        call_deep(lambda: 1 // 0, 1000)
    assert sys.getrecursionlimit() == before
