"""Attackers who guess passwords are slowed down, but teachers and classes can sign in.

One function determines the address of a client.
"""

from __future__ import annotations

import asyncio
import logging
import threading
from typing import Any

import pytest
from django.contrib.auth.hashers import make_password
from django.core.cache import cache
from django.http import HttpResponse
from django.test import Client

from backend.accounts.models import AuditEntry, User
from backend.accounts.sign_in import attempts
from backend.accounts.sign_in.attempts import Attempt, Browser, bounds
from backend.accounts.writes import create_account
from backend.core import clients
from backend.core.clients import address_of, is_on_this_machine, network_of
from backend.ingress.handler import ThreadedHandler
from tests.backend.accounts.conftest import PASSWORD, PUBLIC, Person
from tests.backend.ingress.test_handler import body

ELSEWHERE = "203.0.113.7"


def at(address):
    """Returns a browser on another machine."""
    made = Person()
    made.client.defaults["REMOTE_ADDR"] = address
    return made


def signs_in(browser, name, password=PASSWORD):
    """Returns whether the user is signed in after an attempt."""
    page = browser.form(
        "/accounts/login/", login=name, password=password, expect=(200, 302)[password == PASSWORD]
    )
    return page.status_code == 302


def refused(browser, name, password=PASSWORD):
    return (
        b"Too many failed"
        in browser.form("/accounts/login/", login=name, password=password, expect=200).content
    )


def test_who_signed_in_before_gets_in_whatever_others_guess(team):
    create_account("tina", email="tina@example.org", password=PASSWORD, is_teacher=True)
    tina = Person()
    assert signs_in(tina, "tina")
    tina.form("/accounts/logout/")
    for n in range(60):
        guesser = at(f"198.51.100.{n}")
        guesser.form("/accounts/login/", login="tina", password="wrong", expect=200)
    assert refused(at(ELSEWHERE), "tina")  # after fifty wrong passwords, unknown browsers must wait
    assert signs_in(tina, "TINA@example.org")


def test_five_wrong_passwords_shut_out_the_machine_that_typed_them_and_no_other(team):
    create_account("tina", email="tina@example.org", password=PASSWORD)
    guesser = at(ELSEWHERE)
    for name in ("tina", "tina@example.org", "TINA@EXAMPLE.ORG", "tina", "tina"):
        assert not signs_in(guesser, name, "wrong")
    assert refused(guesser, "tina")
    assert refused(at(ELSEWHERE), "tina")
    assert signs_in(at("203.0.113.8"), "tina")


def test_a_known_browser_has_a_count_of_its_own(team):
    create_account("tina", email="", password=PASSWORD)
    tina = Person()
    assert signs_in(tina, "tina")
    tina.form("/accounts/logout/")
    for _ in range(10):
        assert not signs_in(tina, "tina", "wrong")
    assert refused(tina, "tina")
    assert signs_in(at(ELSEWHERE), "tina")


def test_a_forged_cookie_makes_no_browser_known(team):
    create_account("tina", email="", password=PASSWORD)
    tina = Person()
    signs_in(tina, "tina")
    value = tina.client.cookies[attempts.COOKIE].value
    other_end = value[:-1] + ("A" if value[-1] != "A" else "E")
    for forged in (other_end, value.partition(":")[0], "{}", ""):
        guesser = at(ELSEWHERE)
        guesser.client.cookies[attempts.COOKIE] = forged
        for _ in range(5):
            guesser.form("/accounts/login/", login="tina", password="wrong", expect=200)
        assert refused(guesser, "tina")
        cache.clear()


def test_a_class_signs_in_behind_one_address_at_nine(team):
    hashed = make_password(PASSWORD)
    User.objects.bulk_create(User(username=f"student{n}", password=hashed) for n in range(80))
    first = Person()
    first.page("/accounts/login/")
    token = first.client.cookies["bt_studio_csrf"].value
    answers = []
    for n in range(80):
        browser = Client(HTTP_HOST=PUBLIC, HTTP_ORIGIN=f"http://{PUBLIC}")
        browser.cookies["bt_studio_csrf"] = token
        if n % 4 == 0:  # some mistype
            browser.post(
                "/accounts/login/", {"login": f"student{n}", "password": "x", "csrfmiddlewaretoken": token}
            )
        form = {"login": f"student{n}", "password": PASSWORD, "csrfmiddlewaretoken": token}
        answers.append(browser.post("/accounts/login/", form).status_code)
    assert set(answers) == {302}


def test_three_hundred_of_whom_every_fourth_mistypes_once_meet_no_bound(team):
    for n in range(300):
        if n % 4 == 0:
            assert Attempt(bounds(n, ELSEWHERE, None)).is_allowed
        right = Attempt(bounds(n, ELSEWHERE, None))
        assert right.is_allowed
        right.take_back()


def test_one_machine_that_tries_many_accounts_is_slowed_down(team):
    spray = [Attempt(bounds(f"“user{n}”", ELSEWHERE, None)) for n in range(301)]
    assert [attempt.is_allowed for attempt in spray] == [True] * 300 + [False]
    spray[0].take_back()
    assert Attempt(bounds("“x”", ELSEWHERE, None)).is_allowed
    assert Attempt(bounds("“x”", "203.0.113.8", None)).is_allowed


def test_a_browser_is_known_to_a_few_accounts():
    browser = Browser("b")
    for account in range(20):
        browser = browser.with_account(account)
    assert browser.accounts == tuple(range(8, 20))
    assert browser.with_account(9).accounts[-1] == 9
    assert len(bounds(19, ELSEWHERE, browser)) == 1
    assert len(bounds(1, ELSEWHERE, browser)) == 3


@pytest.mark.parametrize(
    ("address", "network"),
    [("192.0.2.1", "192.0.2.1"), ("2001:db8:1:2:3:4:5:6", "2001:db8:1:2::"), (None, "?"), ("", "?")],
)
def test_of_ipv6_a_network_is_one_address(address, network):
    assert network_of(address) == network


@pytest.mark.parametrize(
    ("hops", "forwarded", "address"),
    [
        (0, "1.2.3.4", "192.0.2.9"),
        (1, "1.2.3.4", "1.2.3.4"),
        (1, "6.6.6.6, 1.2.3.4", "1.2.3.4"),
        (2, "6.6.6.6, 1.2.3.4, 10.0.0.1", "1.2.3.4"),
        (2, "1.2.3.4", "192.0.2.9"),
        (1, "", "192.0.2.9"),
        (1, "rubbish", None),
    ],
)
def test_only_as_many_proxies_are_believed_as_there_are(settings_of, hops, forwarded, address):
    settings_of(proxy_hops=hops)
    assert address_of("192.0.2.9", {"x-forwarded-for": forwarded}) == address


def test_a_proxy_on_this_machine_does_not_ask_for_itself():
    assert is_on_this_machine("127.0.0.1", {})
    assert is_on_this_machine("::1", {})
    for headers in ({"x-forwarded-for": "127.0.0.1"}, {"forwarded": "for=1.2.3.4"}, {"x-real-ip": "::1"}):
        assert not is_on_this_machine("127.0.0.1", headers)
    assert not is_on_this_machine("192.0.2.9", {})
    assert not is_on_this_machine(None, {})


def test_the_audit_log_and_the_counts_use_the_same_address(team, settings_of):
    settings_of(proxy_hops=1)
    browser = Person()
    browser.client.defaults["HTTP_X_FORWARDED_FOR"] = "6.6.6.6, 203.0.113.50"
    browser.form("/accounts/login/", login="nobody", password="wrong", expect=200)
    assert AuditEntry.objects.get(action="login.failed").address == "203.0.113.50"


def test_guests_cannot_escape_their_count_with_a_header(person, settings_of):
    settings_of(expensive_calls_per_minute=2)
    owner = person("olga")
    one = owner.post("projects", {"name": "Robot"}, expect=201)["id"]
    link = owner.post(f"projects/{one}/shares/links", {}, expect=201)["links"][0]["url"].partition(PUBLIC)[2]

    def export(guest, n):
        guest.client.defaults["HTTP_X_FORWARDED_FOR"] = f"198.51.100.{n}"
        response = guest.client.get(f"/api/v1/projects/{one}/export")
        response.getvalue()  # its file ends with the answer
        return response.status_code

    guest = Person()
    guest.page(link)
    assert [export(guest, n) for n in range(4)] == [200, 200, 429, 429]
    second = Person()  # of the same class, with a session of its own
    second.page(link)
    assert export(second, 9) == 200
    codes = []
    for n in range(12):  # many sessions of one address
        another = Person()
        another.page(link)
        codes += [export(another, n), export(another, n)]
    assert codes[-1] == 429


def test_a_proxy_that_the_settings_do_not_know_is_logged_once(team, settings_of, monkeypatch, caplog):
    monkeypatch.setattr(clients.proxies, "is_said", False)
    with caplog.at_level(logging.WARNING, "backend.core.clients"):
        browser = Person()
        browser.page("/accounts/login/")
        assert caplog.text == ""
        browser.client.defaults["HTTP_X_FORWARDED_FOR"] = "203.0.113.50"
        for _ in range(3):
            browser.page("/accounts/login/")
        assert caplog.text.count("BT_STUDIO_PROXY_HOPS") == 1
        caplog.clear()
        clients.proxies.at_start()
        assert caplog.text == ""
        settings_of(mode="team", public_url=f"https://{PUBLIC}")
        clients.proxies.at_start()
        assert "BT_STUDIO_PROXY_HOPS" in caplog.text
        caplog.clear()
        settings_of(proxy_hops=1)
        clients.proxies.at_start()
        clients.proxies.see({"x-forwarded-for": "1.1.1.1"})
        assert caplog.text == ""


def test_hashing_passwords_leaves_threads_to_the_others(monkeypatch):
    handling = ThreadedHandler(hashing=2)
    let_go, hashing = threading.Event(), threading.Semaphore(0)
    most, lock, inside = [0], threading.Lock(), [0]

    def answer(request):
        if request.path == "/accounts/login/":
            with lock:
                inside[0] += 1
                most[0] = max(most[0], inside[0])
            hashing.release()
            let_go.wait(60)
            with lock:
                inside[0] -= 1
        return HttpResponse(request.path)

    monkeypatch.setattr(handling, "get_response", answer)

    async def ask(method, path):
        sent, waiting = [], [body(b"")]

        async def receive():
            return waiting.pop(0)

        async def send(message):
            sent.append(message)

        scope: Any = {"type": "http", "method": method, "path": path, "query_string": b"", "headers": []}
        await handling(scope, receive, send)
        return sent[0]["status"]

    async def nine_o_clock():
        signing_in = [asyncio.create_task(ask("POST", "/accounts/login/")) for _ in range(30)]
        await asyncio.to_thread(hashing.acquire)
        async with asyncio.timeout(60):
            others = await asyncio.gather(*(ask("GET", "/") for _ in range(20)))
        let_go.set()
        return others + await asyncio.gather(*signing_in)

    assert set(asyncio.run(nine_o_clock())) == {200}
    assert most[0] == 2
