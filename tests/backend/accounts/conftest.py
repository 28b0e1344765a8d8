"""A server with accounts, in the process of the tests; users sign in through the real pages."""

from __future__ import annotations

import json
import os

import pytest
from django.conf import settings as django_settings
from django.core.cache import cache
from django.test import Client, override_settings

from backend.accounts.sign_in import signals
from backend.accounts.writes import create_account
from backend.config.environment import environment
from tests.backend.conftest import Api

PUBLIC = "bt.example.org"
PASSWORD = "Correct-horse-9"


class Person(Api):
    """The browser of one user on a server with accounts."""

    def __init__(self, user=None):
        self.user = user
        self.client = Client(HTTP_HOST=PUBLIC, HTTP_ORIGIN=f"http://{PUBLIC}", enforce_csrf_checks=True)
        self.client.raise_request_exception = True

    def form(self, path, *, expect=302, **fields):
        """Opens a page with a form, fills it in and sends it."""
        page = self.client.get(path)
        assert page.status_code == 200, (page.status_code, page.content[:500])
        token = self.client.cookies[django_settings.CSRF_COOKIE_NAME].value
        response = self.client.post(path, fields | {"csrfmiddlewaretoken": token})
        assert response.status_code == expect, (response.status_code, response.content[-3000:])
        return response

    def sign_in(self, name=None, password=PASSWORD, **options):
        return self.form("/accounts/login/", login=name or self.user.username, password=password, **options)

    def quick(self):
        """Signs the user in without the page, whose password hashing is slow."""
        self.client.force_login(self.user)
        return self

    def page(self, path):
        return self.client.get(path)

    def problem(self, method, path, status, body=None):
        document = json.loads(json.dumps(self.call(method, path, body, expect=status)))
        return document["code"]


@pytest.fixture
def team(settings_of, db, tmp_path):
    """Team mode: settings, addresses and middleware as `serve` would have them."""
    settings_of(
        mode="team",
        unsafe_users_run_as_server="true",
        public_url=f"http://{PUBLIC}",
        # The database is that of the tests; only the setting must exist.
        database_url=os.environ.get("BT_STUDIO_DATABASE_URL", f"sqlite:///{tmp_path}/unused"),
        secret_key="s" * 40,
    )
    cache.clear()
    signals.connect()
    with override_settings(
        ROOT_URLCONF=django_settings.TEAM_URLS,
        MIDDLEWARE=django_settings.TEAM_MIDDLEWARE,
        CSRF_TRUSTED_ORIGINS=[f"http://{PUBLIC}"],
        PASSWORD_HASHERS=["django.contrib.auth.hashers.MD5PasswordHasher"],
    ):
        yield environment()
    cache.clear()


@pytest.fixture
def person(team):
    """Makes accounts that are signed in."""

    def make(name, **rights):
        user = create_account(name, email=f"{name}@example.org", password=PASSWORD, **rights)
        return Person(user).quick()

    return make


@pytest.fixture
def stranger(team):
    """A browser in which nobody is signed in."""
    return Person()
