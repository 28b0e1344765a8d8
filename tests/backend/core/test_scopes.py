"""Reads of ASGI scopes."""

from __future__ import annotations

from typing import Any

import pytest

from backend.core.scopes import cookies_of, facts_of, headers_of, scheme_of

SCOPE: Any = {
    "type": "http",
    "method": "POST",
    "scheme": "http",
    "headers": [(b"Host", b"127.0.0.1:8000"), (b"AUTHORIZATION", b"Bearer t0ken"), (b"origin", b"http://x")],
}


def test_headers_and_facts_are_read() -> None:
    assert headers_of(SCOPE)["host"] == "127.0.0.1:8000"
    facts = facts_of(SCOPE)
    assert (facts.method, facts.bearer, facts.origin, facts.cookie) == ("POST", "t0ken", "http://x", None)
    assert not facts.socket


@pytest.mark.parametrize(("header", "cookies"), [("a=1; b=2", {"a": "1", "b": "2"}), ("", {})])
def test_cookies_are_read(header: str, cookies: dict[str, str]) -> None:
    assert cookies_of(header) == cookies


def test_the_scheme_of_a_proxy_counts_if_there_is_one(settings_of) -> None:
    told = {"x-forwarded-proto": "https"}
    assert scheme_of(SCOPE, told) == "http"
    settings_of(proxy_hops=1)
    assert scheme_of(SCOPE, told) == "https"
