"""Owners of shared resources: a client cannot become another owner by the data that it sends."""

from __future__ import annotations

import pytest

from backend.accounts.identity import identify
from backend.ingress.owners import owner_of
from backend.ingress.sockets import OF_A_USER, OF_AN_ADDRESS, Crowd
from tests.backend.accounts.conftest import PUBLIC

pytestmark = pytest.mark.django_db(transaction=True)


def scope_of(cookies="", client=("192.0.2.7", 4711), **headers):
    given = {"host": PUBLIC, "cookie": cookies} | headers
    pairs = [(name.replace("_", "-").encode(), value.encode()) for name, value in given.items()]
    return {"type": "http", "method": "GET", "path": "/", "headers": pairs, "client": client}


def shown(browser):
    return "; ".join(f"{name}={morsel.value}" for name, morsel in browser.client.cookies.items())


def test_a_user_counts_alone_once_their_session_was_read(person):
    ann = person("ann")
    assert owner_of(scope_of(shown(ann))) == "address 192.0.2.7"
    identify({name: morsel.value for name, morsel in ann.client.cookies.items()})
    assert owner_of(scope_of(shown(ann))) == f"user {ann.user.pk}"
    assert owner_of(scope_of(shown(ann), client=("192.0.2.8", 1))) == f"user {ann.user.pk}"


@pytest.mark.parametrize(
    "lies",
    [
        {"cookies": "sessionid=made-up"},
        {"cookies": "\x00; =;"},
        {"x_forwarded_for": "203.0.113.9"},
        {"x_real_ip": "203.0.113.9", "forwarded": "for=203.0.113.9"},
    ],
)
def test_what_a_stranger_sends_changes_nothing(team, lies):
    assert owner_of(scope_of(**lies)) == "address 192.0.2.7"


def test_an_address_of_ipv6_is_a_network(team):
    owners = {owner_of(scope_of(client=(f"2001:db8::{n}", 1))) for n in (1, 2, "ffff")}
    assert len(owners) == 1
    assert owner_of(scope_of(client=None)) == "address ?"


@pytest.mark.parametrize(("owner", "most"), [("user 1", OF_A_USER), ("address 192.0.2.7", OF_AN_ADDRESS)])
async def test_sockets_of_one_owner_are_counted_until_they_end(team, owner, most):
    crowd, held = Crowd(), []
    for _ in range(most):
        held.append(crowd.place(owner))
        assert await held[-1].__aenter__() is not None
    async with crowd.place(owner) as refused, crowd.place("user 2") as other:
        assert refused is None
        assert other is not None
    await held.pop().__aexit__(None, None, None)
    async with crowd.place(owner) as again:
        assert again is not None
    for place in held:
        await place.__aexit__(None, None, None)
    assert not crowd.sockets
