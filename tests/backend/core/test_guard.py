"""The clients that a server on localhost accepts."""

from __future__ import annotations

from typing import Any

import pytest

from backend.core.guard import Facts, Keys, cookie_name, host_name, judge, schemes_of

KEYS = Keys("secret-token")
HOST = "127.0.0.1:8000"
COOKIE = KEYS.cookie_value


def refused(**facts):
    refusal = judge(Facts(**{"method": "GET", "host": HOST, "cookie": COOKIE} | facts), KEYS)
    return refusal.code if refusal else None


@pytest.mark.parametrize("host", ["127.0.0.1:8000", "localhost:8000", "LOCALHOST", "[::1]:8000", "127.0.0.1"])
def test_loopback_names_pass_on_any_port(host):
    assert refused(host=host) is None


@pytest.mark.parametrize(
    "host",
    [
        "evil.example",
        "evil.example:8000",
        "127.0.0.1.evil.example:8000",
        "",
        "localhost.:8000",
        "0.0.0.0:8000",
        "localhost@evil.example",
        "127.0.0.1:8000.evil.example",
    ],
)
def test_a_rebound_name_gets_nothing_even_with_the_cookie(host):
    assert refused(host=host) == "host_refused"


def test_a_host_can_be_allowed():
    facts = Facts("GET", "studio.lan:8000", cookie=COOKIE)
    assert judge(facts, KEYS, extra_hosts=("studio.lan",)) is None


@pytest.mark.parametrize("method", ["POST", "PUT", "PATCH", "DELETE", "GET"])
@pytest.mark.parametrize(
    "origin",
    [
        "http://evil.example",
        "null",
        "http://127.0.0.1:9000",
        "http://localhost:8000",
        "https://127.0.0.1",
        "",
        "file://",
    ],
)
def test_a_foreign_origin_gets_nothing(method, origin):
    assert refused(method=method, origin=origin) == "origin_refused"


def test_our_own_origin_passes():
    assert refused(method="POST", origin="http://127.0.0.1:8000") is None
    assert refused(socket=True, origin="http://127.0.0.1:8000") is None


def test_a_browser_that_says_cross_site_without_an_origin_is_refused():
    assert refused(method="POST", fetch_site="cross-site") == "origin_refused"
    assert refused(method="POST", fetch_site="same-site") == "origin_refused"
    assert refused(method="POST", fetch_site="same-origin") is None
    assert refused(method="GET", fetch_site="cross-site") is None


def test_a_socket_needs_an_origin_or_the_token():
    assert refused(socket=True) == "origin_refused"
    assert refused(socket=True, cookie=None, bearer="secret-token") is None


@pytest.mark.parametrize("cookie", [None, "", "secret-token", "x" * 64, "é"])
def test_without_the_cookie_nothing_passes(cookie):
    assert refused(cookie=cookie) == "link_required"


@pytest.mark.parametrize("bearer", ["", "wrong", COOKIE])
def test_a_wrong_token_is_no_token(bearer):
    assert refused(cookie=None, bearer=bearer) == "link_required"


def test_cookie_and_token_do_not_give_each_other():
    assert KEYS.token not in KEYS.cookie_value
    assert Keys("another").cookie_value != KEYS.cookie_value


def test_servers_on_two_ports_have_two_cookies():
    assert cookie_name("127.0.0.1:8000") != cookie_name("127.0.0.1:8001")
    assert cookie_name("localhost") == "bt_studio_session"


def test_host_names_lose_their_port_and_nothing_else():
    assert host_name("[::1]:80") == "[::1]"
    assert host_name("A.B") == "a.b"


@pytest.mark.parametrize(
    ("public_url", "host", "connection", "schemes"),
    [
        ("", "127.0.0.1:8000", "http", ("http",)),
        ("", "studio.lan:8000", "http", ("http", "https")),
        ("https://bt.example.org", "bt.example.org", "http", ("https",)),
        ("https://bt.example.org", "BT.example.org", "http", ("https",)),
        ("http://bt.example.org", "bt.example.org", "https", ("http",)),
        ("https://bt.example.org", "other.example.org", "http", ("https",)),
        ("https://bt.example.org", "localhost:8000", "http", ("http",)),
    ],
)
def test_a_host_is_opened_by_the_scheme_of_the_settings(settings_of, public_url, host, connection, schemes):
    settings_of(public_url=public_url)
    assert schemes_of(host, connection) == schemes


def test_a_page_that_came_by_plain_http_is_not_of_a_server_with_tls():
    facts: Any = {"host": "bt.example.org", "schemes": ("https",), "method": "POST", "socket": True}
    judged = [
        judge(
            Facts(origin=f"{scheme}://bt.example.org", **facts),
            KEYS,
            extra_hosts=("bt.example.org",),
            accounts=True,
        )
        for scheme in ("https", "http", "ftp")
    ]
    assert [refusal and refusal.code for refusal in judged] == [None, "origin_refused", "origin_refused"]
