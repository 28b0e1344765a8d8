"""Bodies of requests."""

from __future__ import annotations

import io

import pytest
from rest_framework.exceptions import ParseError

from backend.core.rest.parsers import StrictJSONParser, TooLargeError


def parse(raw: bytes) -> object:
    return StrictJSONParser().parse(io.BytesIO(raw))


def test_json_is_read() -> None:
    assert parse('{"a": "ü\\u00fc"}'.encode()) == {"a": "üü"}


@pytest.mark.parametrize(
    "raw",
    [b"{", b"[NaN]", b"[Infinity]", b'["\\ud800"]', b"\xff", b"[" * 100_000],
    ids=lambda raw: str(raw[:12]),
)
def test_what_the_database_could_not_hold_is_refused(raw: bytes) -> None:
    with pytest.raises(ParseError):
        parse(raw)


def test_a_body_has_a_limit(settings_of) -> None:
    settings_of(max_request_bytes=1_000_000)
    with pytest.raises(TooLargeError):
        parse(b" " * 1_000_001)
