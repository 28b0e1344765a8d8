"""Merged orders of siblings."""

from __future__ import annotations

import pytest

from translator.merge.order import merge_order


@pytest.mark.parametrize(
    ("sides", "members", "found"),
    [
        (("abc", "abc", "cab"), "abc", ("cab", False)),
        (("abc", "cab", "abc"), "abc", ("cab", False)),
        (("abc", "cab", "cab"), "abc", ("cab", False)),
        (("abc", "cab", "bac"), "abc", ("cab", True)),
        (("abc", "axbc", "aybc"), "abcxy", ("axybc", False)),
        (("abc", "xabc", "abcy"), "abcxy", ("xabcy", False)),
        (("abc", "abcx", "cab"), "abcx", ("cxab", False)),
        (("abc", "abc", "ac"), "ac", ("ac", False)),
        (("ab", "nab", "abn"), "abn", ("nab", True)),
        (("xabc", "acb", "abcx"), "abcx", ("acbx", False)),  # x was put behind the others
        (("abx", "ba", "axb"), "abx", ("xba", False)),  # x was put before b
        (("", "", ""), "q", ("q", False)),
    ],
)
def test_orders(sides, members, found):
    order, is_conflict = merge_order(sides, members)
    assert ("".join(order), is_conflict) == found
