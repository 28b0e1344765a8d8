"""An account that is revoked, changed or signed out is refused at its next request by every web server.

There are two real servers on one PostgreSQL and one Redis. Both have served the account just before, so that
their caches contain its session. The change comes through the first server, or from a third process that can
notify neither of them.
"""

from __future__ import annotations

import re
from contextlib import ExitStack

import pytest
import requests

from tests.backend.programs import run_program, sign_in
from tests.backend.services import redis
from tests.backend.serving import serving
from tests.backend.test_postgresql import PASSWORD, signed_in
from tests.benchmarks.load import settings_of

ACCOUNTS = 9
pytestmark = pytest.mark.timeout(300)


def token_of(page):
    return page.text.partition('name="csrfmiddlewaretoken" value="')[2].partition('"')[0]


class Browser:
    """The browser of an account that is signed in, as both servers see it."""

    def __init__(self, servers, name, cookie):
        self.name, self._servers = name, servers
        self._client = requests.Session()
        self._client.cookies.set(*cookie.split("=", 1))

    def ask(self, method, path, body=None):
        """The statuses with which the servers answer."""
        return [self.call(server, method, path, body).status_code for server in self._servers]

    def call(self, server, method, path, body=None):
        headers = {"Origin": server.base}
        return self._client.request(method, f"{server.base}/api/v1/{path}", json=body, headers=headers)

    def form(self, server, path, **fields):
        """Opens a page with a form, and sends it."""
        page = self._client.get(f"{server.base}{path}")
        assert page.status_code == 200, page.text
        headers = {"Origin": server.base}
        fields["csrfmiddlewaretoken"] = token_of(page)
        answer = self._client.post(
            f"{server.base}{path}", data=fields, headers=headers, allow_redirects=False
        )
        assert answer.status_code == 302, answer.text


class Team:
    """The servers, their accounts, and an administrator who is signed in at the first."""

    def __init__(self, stack, folder, database_url):
        services = {
            "BT_STUDIO_DATABASE_URL": database_url,
            "BT_STUDIO_REDIS_URL": stack.enter_context(redis()),
        }
        self._settings, _ = settings_of(services)
        self._folder = folder / "first"
        self.servers = []
        for own in (self._folder, folder / "second"):
            own.mkdir()
            self.servers.append(stack.enter_context(serving(own, **self._settings)))
        self.first = self.servers[0]
        cookies = [cookie for _, cookie in sign_in(self._folder, self._settings, ACCOUNTS)]
        self._free = [Browser(self.servers, f"editor{n}", cookie) for n, cookie in enumerate(cookies)]
        self.terminal("create", "root", "--password-stdin", text=f"{PASSWORD}\n")
        client = signed_in(self.first, "root")
        cookie = next(one for one in client.cookies if one.name.endswith("session"))
        self.root = Browser(self.servers, "root", f"{cookie.name}={cookie.value}")
        page = client.get(f"{self.first.base}/admin/accounts/user/")
        self._page_of = {
            name: path
            for path, name in re.findall(r'href="(/admin/accounts/user/\d+/)change/">(\w+)<', page.text)
        }

    def account(self):
        """An account that no other test uses, and that both servers have seen."""
        found = self._free.pop()
        assert found.ask("GET", "me") == [200, 200]
        return found

    def terminal(self, *arguments, text=""):
        """`bt-studio admin`."""
        own = {**self._settings, "BT_STUDIO_DATA_DIR": str(self._folder)}
        run_program("backend.cli.main", "admin", *arguments, said=text, **own)

    def edit(self, account, **rights):
        """Sets the rights of an account on its administration page; all others are removed."""
        fields = dict.fromkeys(("first_name", "last_name", "email", "max_bytes", "max_projects"), "")
        page = f"{self._page_of[account.name]}change/"
        self.root.form(self.first, page, username=account.name, **fields, **rights)

    def page_of(self, account):
        """The beginning of the addresses of the account's administration pages."""
        return self._page_of[account.name]


@pytest.fixture(scope="module")
def team(tmp_path_factory, warm_postgresql):
    with ExitStack() as stack:
        database_url = stack.enter_context(warm_postgresql.database_url())
        yield Team(stack, tmp_path_factory.mktemp("servers"), database_url)


def signs_out(team, account):
    account.form(team.first, "/accounts/logout/")


def is_deactivated(team, account):
    team.edit(account)


def is_deactivated_in_the_list(team, account):
    number = team.page_of(account).split("/")[-2]
    team.root.form(team.first, "/admin/accounts/user/", action="deactivate", _selected_action=number)


def has_another_password(team, account):
    page = f"{team.page_of(account)}password/"
    new = {"password1": "Another-horse-7", "password2": "Another-horse-7", "usable_password": "true"}
    team.root.form(team.first, page, **new)


def is_deleted_in_a_terminal(team, account):
    team.terminal("delete-user", account.name, "--yes")


@pytest.mark.parametrize(
    "change",
    [
        signs_out,
        is_deactivated,
        is_deactivated_in_the_list,
        has_another_password,
        is_deleted_in_a_terminal,
    ],
)
def test_an_account_is_out_at_its_next_request(team, change):
    account = team.account()
    kept = dict(account._client.cookies)
    change(team, account)
    account._client.cookies.update(kept)  # a copy of the cookie does not help
    assert account.ask("GET", "me") == [401, 401]
    assert account.ask("POST", "projects", {"name": "Robot"}) == [401, 401]


def test_a_teacher_who_is_no_teacher_any_more_makes_no_groups(team):
    account = team.account()
    team.edit(account, is_active="on", is_teacher="on")
    assert account.ask("POST", "groups", {"name": "Robotics"}) == [201, 201]
    team.edit(account, is_active="on")
    assert account.ask("POST", "groups", {"name": "Robotics"}) == [403, 403]


def test_an_editor_who_becomes_a_viewer_saves_no_more_and_then_sees_nothing(team):
    owner, friend = team.account(), team.account()
    made = owner.call(team.first, "POST", "projects", {"name": "Shared"}).json()["id"]
    share = f"projects/{made}/shares"

    def saves(name):
        """The statuses of a new file at each server."""
        answers = []
        for number, server in enumerate(team.servers):
            file = {"path": f"{name}{number}.txt", "base_revision": 0, "content": ""}
            answers.append(friend.call(server, "POST", f"projects/{made}/changes", {"files": [file]}))
        return [answer.status_code for answer in answers]

    for role, statuses in (("editor", [200, 200]), ("viewer", [403, 403])):
        owner.call(team.first, "POST", share, {"name": friend.name, "role": role})
        assert saves(role) == statuses
    assert friend.ask("GET", f"projects/{made}") == [200, 200]
    owner.call(team.first, "DELETE", f"{share}/people/{friend.name}")
    assert friend.ask("GET", f"projects/{made}") == [404, 404]
