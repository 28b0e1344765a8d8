"""The header `Range`."""

from __future__ import annotations

import pytest

from backend.runs.errors import BadRangeError
from backend.runs.ranges import asked_range


@pytest.mark.parametrize(
    ("header", "wanted"),
    [
        ("bytes=0-", (0, 100)),
        ("bytes=10-19", (10, 20)),
        ("bytes=90-999", (90, 100)),
        ("bytes=-5", (95, 100)),
        ("bytes=-500", (0, 100)),
        ("", None),
        ("bytes=-", None),
        ("bytes=20-10", None),
        ("bytes=0-1,5-6", None),
        ("items=0-1", None),
    ],
)
def test_one_range_is_understood_and_all_else_means_all(header, wanted):
    assert asked_range(header, 100) == wanted


@pytest.mark.parametrize("header", ["bytes=100-", "bytes=200-300", "bytes=-0"])
def test_a_range_after_the_end_is_refused(header):
    with pytest.raises(BadRangeError, match="100 bytes"):
        asked_range(header, 100)
