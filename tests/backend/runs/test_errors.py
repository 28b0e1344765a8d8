"""A range that is not in a recording."""

from __future__ import annotations

from backend.runs.errors import BadRangeError


def test_a_range_past_the_end_tells_the_size() -> None:
    error = BadRangeError(10)

    assert error.headers["Content-Range"] == "bytes */10"
    assert "10 bytes" in str(error)
