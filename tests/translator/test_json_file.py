"""Any bytes give a value, or a finding with its line."""

from __future__ import annotations

import pytest

from translator import json_file
from translator.json_file import parse_json


def test_json_is_read_with_and_without_a_mark_at_its_beginning() -> None:
    assert parse_json(b'{"a": 1}', file="a.json") == ({"a": 1}, None)
    assert parse_json(b"\xef\xbb\xbf[]", file="a.json") == ([], None)


@pytest.mark.parametrize(
    ("raw", "code", "line"),
    [
        (b'{\n"a": }', "BT0001", 2),
        (b"{\n\xff}", "BT0002", 2),
        (b"[" * 200_000, "BT0001", 1),
        (b"9" * 10_000, "BT0001", 1),
    ],
)
def test_what_is_no_json_is_a_finding(raw: bytes, code: str, line: int) -> None:
    value, found = parse_json(raw, file="a.json")
    assert value is None
    assert found is not None
    assert (found.code, found.place.line) == (code, line)


def test_a_file_that_is_too_large_is_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(json_file, "FILE_BYTES", 3)
    _, found = parse_json(b"[0]\n", file="a.json")
    assert found is not None
    assert found.code == "BT0003"
