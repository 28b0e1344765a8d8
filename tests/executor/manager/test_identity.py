"""The name of a user in a header."""

from __future__ import annotations

import pytest

from backend.sessions.manager import sockets
from executor.manager.identity import MOST_CHARACTERS, USER_HEADER, user_of


@pytest.mark.parametrize(
    ("header", "user"),
    [
        (None, None),
        ("", ""),
        ("ada", "ada"),
        ("J%C3%BCrgen%20O%27Neil", "Jürgen O'Neil"),
        ("%FF", "\N{REPLACEMENT CHARACTER}"),
    ],
)
def test_a_name_is_read_from_its_header(header: str | None, user: str | None) -> None:
    assert user_of(header) == user


def test_a_long_name_is_cut() -> None:
    assert user_of("x" * 1000) == "x" * MOST_CHARACTERS


def test_the_web_server_writes_the_same_header() -> None:
    assert sockets.USER_HEADER == USER_HEADER
