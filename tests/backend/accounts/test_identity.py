"""A session is checked at each request, and is never valid for longer than the database says."""

from __future__ import annotations

from datetime import timedelta

import pytest
from cachetools import LRUCache
from django.conf import settings
from django.contrib.sessions.models import Session
from django.utils import timezone

from backend.accounts import identity
from backend.accounts.models import User


def known(person):
    """A user whose session was read before, and a function that reads it."""
    ada = person("ada")
    cookies = {name: morsel.value for name, morsel in ada.client.cookies.items()}

    def who():
        return identity.identify(cookies)

    assert who() == ada.user
    return ada, who


def test_a_session_that_was_seen_takes_one_query(person, django_assert_num_queries):
    _, who = known(person)
    with django_assert_num_queries(1):
        found = who()
    identity.seen_users.clear()
    with django_assert_num_queries(2):
        expected = who()
    fields = [field.attname for field in User._meta.concrete_fields]
    assert [getattr(found, name) for name in fields] == [getattr(expected, name) for name in fields]
    assert found.links == expected.links


def test_a_session_that_is_another_users_by_now_is_theirs(person):
    ada, who = known(person)
    bob = person("bob")
    ada.client.force_login(bob.user)  # the same browser, with a new key
    key = ada.client.cookies[settings.SESSION_COOKIE_NAME].value
    identity.seen_users[key] = ada.user.pk
    assert identity.identify({settings.SESSION_COOKIE_NAME: key}) == bob.user
    assert who() is None


def signs_out(ada):
    ada.form("/accounts/logout/")


def is_deactivated(ada):
    User.objects.filter(pk=ada.user.pk).update(is_active=False)


def has_another_password(ada):
    ada.user.set_password("Another-horse-7")
    ada.user.save()


def is_gone(ada):
    ada.user.delete()


def stayed_away_too_long(ada):
    Session.objects.update(expire_date=timezone.now() - timedelta(seconds=1))


@pytest.mark.parametrize(
    "what", [signs_out, is_deactivated, has_another_password, is_gone, stayed_away_too_long]
)
def test_an_account_that_may_no_longer_is_out_at_once(person, what):
    ada, who = known(person)
    what(ada)
    assert who() is None


def test_a_change_of_what_the_session_holds_is_seen(person):
    owner = person("olga")
    one = owner.post("projects", {"name": "Robot"}, expect=201)["id"]
    link = owner.post(f"projects/{one}/shares/links", {}, expect=201)["links"][0]
    ada, who = known(person)
    ada.get(f"projects/{one}", expect=404)
    ada.page(link["url"].partition(settings.ENVIRONMENT.public_host or "bt.example.org")[2])
    assert len(who().links) == 1
    assert ada.get(f"projects/{one}")["role"] == "viewer"


def test_only_so_many_are_remembered(person, monkeypatch):
    monkeypatch.setattr(identity, "seen_users", LRUCache(2))
    cookies = []
    for name in ("ada", "bob", "cleo"):
        ada = person(name)
        cookies.append({name: morsel.value for name, morsel in ada.client.cookies.items()})
        identity.identify(cookies[-1])
    assert [identity.last_seen(one) is not None for one in cookies] == [False, True, True]
