"""Sign-in by a university's provider: who may sign in, and that the browser is known from then on."""

from __future__ import annotations

from typing import Any

import pytest
from django.conf import settings
from django.test import override_settings

from backend.accounts.models import AuditEntry, User
from backend.accounts.sign_in import attempts
from tests.backend.accounts.conftest import PASSWORD, PUBLIC, Person
from tests.fakes.identity_provider import CLIENT_ID, SECRET, identity_provider

TINA = {"sub": "77", "email": "tina@example.org", "email_verified": True, "preferred_username": "tina"}
SIGN_IN = "/accounts/oidc/oidc/login/"


@pytest.fixture
def provider(team):
    with identity_provider() as found:
        app = {"provider_id": "oidc", "name": "University", "client_id": CLIENT_ID, "secret": SECRET}
        apps = [app | {"settings": {"server_url": found.issuer}}]
        one = {"openid_connect": settings.SOCIALACCOUNT_PROVIDERS["openid_connect"] | {"APPS": apps}}
        with override_settings(SOCIALACCOUNT_PROVIDERS=one):
            yield found


def comes(browser, provider, **person):
    """Signs in at the provider; returns the address of the redirect."""
    provider.person = TINA | person
    token = browser.page("/accounts/login/") and browser.client.cookies[settings.CSRF_COOKIE_NAME].value
    started = browser.client.post(SIGN_IN, {"csrfmiddlewaretoken": token})
    assert started.status_code == 302
    assert started["Location"].startswith(f"{provider.issuer}/authorize")
    return browser.client.get(provider.authorize(started["Location"]))


def test_who_comes_from_the_provider_is_in_and_their_browser_is_known(provider):
    tina = Person()
    answer = comes(tina, provider)
    assert (answer.status_code, answer["Location"]) == (302, "/")
    assert tina.get("me")["user"] == "tina"
    user = User.objects.get(username="tina")
    assert AuditEntry.objects.filter(action="login", actor=user).exists()
    morsel = tina.client.cookies[attempts.COOKIE]
    assert morsel["httponly"]
    assert morsel["samesite"] == "Lax"
    request: Any = type("Request", (), {"COOKIES": {attempts.COOKIE: morsel.value}})
    assert attempts.browser_of(request).accounts == (user.pk,)


def test_that_browser_gets_in_by_password_whatever_others_guess(provider):
    """The cookie belongs to a teacher who signed in by the provider once, and also has a password."""
    tina = Person()
    comes(tina, provider)
    tina.form("/accounts/logout/")
    user = User.objects.get(username="tina")
    user.set_password(PASSWORD)
    user.save()
    stranger = Person()
    for n in range(60):
        stranger.client.defaults["REMOTE_ADDR"] = f"198.51.100.{n}"
        stranger.form("/accounts/login/", login="tina", password="wrong", expect=200)
    assert (
        b"Too many failed"
        in stranger.form("/accounts/login/", login="tina", password=PASSWORD, expect=200).content
    )
    tina.form("/accounts/login/", login="tina", password=PASSWORD)
    assert tina.get("me")["user"] == "tina"


def test_a_second_sign_in_by_the_provider_makes_no_second_account(provider):
    comes(Person(), provider)
    again = Person()
    comes(again, provider)
    assert again.get("me")["user"] == "tina"
    assert User.objects.filter(username__startswith="tina").count() == 1


def test_the_list_of_domains_bounds_who_comes(provider, settings_of):
    settings_of(mode="team", public_url=f"http://{PUBLIC}", allowed_email_domains='["other.example"]')
    refused = Person()
    assert comes(refused, provider).status_code == 200  # a page that says so
    assert refused.problem("GET", "me", 401) == "sign_in_required"
    assert attempts.COOKIE not in refused.client.cookies
    assert not User.objects.filter(username="tina").exists()


def test_a_link_back_that_nobody_began_brings_nobody_in(provider):
    victim = Person()
    provider.person = TINA
    answer = victim.page("/accounts/oidc/oidc/login/callback/?code=code-1&state=forged")
    assert "/token" not in provider.asked
    assert answer.status_code == 401
    assert victim.problem("GET", "me", 401) == "sign_in_required"
