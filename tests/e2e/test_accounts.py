"""A class on a server with accounts, from the teacher's first sign-in to the end of a pupil's account."""

from __future__ import annotations

import base64
import hmac
import os
import re
import socket
import struct
import subprocess
import time
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_no_findings
from tests.e2e.mailbox import Mailbox, mailbox
from tests.e2e.server import Server, command, serving
from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from typing import Any

    from playwright.sync_api import Browser, ViewportSize

    AriaRole = Any  # playwright's own list of names

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]

PASSWORD, ANOTHER = "Correct-horse-9", "Battery-staple-4"


@pytest.fixture
def mails() -> Iterator[Mailbox]:
    """Runs the mail server of the server under test."""
    with mailbox() as box:
        yield box


@pytest.fixture
def team(tmp_path: Path, mails: Mailbox) -> Iterator[Server]:
    """Runs a server with accounts that sends mail, with one account: Ada, its administrator."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    settings = {
        "BT_STUDIO_MODE": "team",
        "BT_STUDIO_UNSAFE_USERS_RUN_AS_SERVER": "true",
        "BT_STUDIO_PUBLIC_URL": f"http://127.0.0.1:{port}",
        "BT_STUDIO_DATABASE_URL": f"sqlite:///{tmp_path}/team.sqlite3",
        "BT_STUDIO_SECRET_KEY": "k" * 40,
        "BT_STUDIO_SMTP_URL": mails.url,
        "BT_STUDIO_MAIL_FROM": "BT Studio <bt@example.org>",
    }
    with serving(tmp_path, "--port", str(port), **settings) as server:
        make = command("admin", "create", "ada", "--email", "ada@example.org", "--password-stdin")
        data = {"BT_STUDIO_DATA_DIR": str(tmp_path / "data")}
        subprocess.run(make, env=os.environ | settings | data, input=PASSWORD, text=True, check=True)
        yield server


class Someone(Studio):
    """The browser of one user."""

    def go(self, address: str) -> None:
        """Opens a page of the server."""
        self.page.goto(address if address.startswith("http") else self.server.origin + address)

    def press(self, role: AriaRole, name: str) -> None:
        """Clicks the element with this name."""
        self.page.get_by_role(role, name=name, exact=True).click()

    def type(self, label: str, text: str) -> None:
        """Fills in a field."""
        self.page.get_by_label(label, exact=True).fill(text)

    def sign_in(self, name: str, password: str = PASSWORD) -> None:
        """Signs in by keyboard alone."""
        self.page.get_by_label("Login").focus()
        for text, key in ((name, "Tab"), (password, "Enter")):
            self.page.keyboard.type(text)
            self.page.keyboard.press(key)

    def menu(self, item: str) -> None:
        """Clicks an item of the account's menu."""
        self.page.get_by_role("button", name="Account of").click()
        self.press("menuitem", item)

    def comes_to(self, address: str) -> None:
        """Waits for a page whose address contains this."""
        expect(self.page).to_have_url(re.compile(re.escape(address)))

    def can_be_used(self, name: str) -> None:
        """In both themes axe finds nothing serious, and a narrow window cuts nothing off."""
        for scheme in ("light", "dark"):
            self.page.evaluate(
                "scheme => { const root = document.documentElement.dataset;"
                " root.mantineColorScheme = scheme; root.theme = scheme }",
                scheme,
            )
            expect_no_findings(self.page, f"{name}, {scheme}")
        self.page.set_viewport_size({"width": 400, "height": 800})
        beyond = self.page.evaluate("document.documentElement.scrollWidth - innerWidth")
        assert beyond <= 0, f"{name} is {beyond} px too wide for a narrow window"
        self.page.set_viewport_size({"width": 1440, "height": 900})


def code_of(secret: str) -> str:
    """Returns the code of an authenticator for a secret at this moment (RFC 6238)."""
    key = base64.b32decode(secret + "=" * (-len(secret) % 8))
    digest = hmac.digest(key, struct.pack(">Q", int(time.time()) // 30), "sha1")
    start = digest[-1] & 15
    (number,) = struct.unpack(">I", digest[start : start + 4])
    return f"{(number & 0x7FFFFFFF) % 1_000_000:06d}"


@pytest.fixture
def people(team: Server, browser: Browser) -> Iterator[list[Someone]]:
    """Opens three browsers; their consoles must stay empty."""
    size: ViewportSize = {"width": 1440, "height": 900}
    contexts = [browser.new_context(viewport=size, accept_downloads=True) for _ in range(3)]
    everyone = [Someone(context.new_page(), team) for context in contexts]
    for someone in everyone:
        # Wrong passwords and codes, and what one may not see, are the subject.
        someone.may_be_refused(r"4\d\d .*")
    yield everyone
    for someone in everyone:
        someone.page.context.close()
        assert someone.complaints == [], "the browser's console must stay empty"


def test_a_class_from_the_first_sign_in_to_the_end_of_an_account(
    people: list[Someone], mails: Mailbox
) -> None:
    ada, bob, guest = people
    signs_in_where_she_wanted_to_go(ada)
    invites_to_a_class(ada, bob, mails)
    shares_a_project_and_gives_it_away(ada, bob, guest)
    announces_an_upgrade(ada, bob)
    takes_a_second_factor(ada)
    forgets_the_password(bob, mails)
    takes_everything_along_and_goes(bob)


def signs_in_where_she_wanted_to_go(ada: Someone) -> None:
    ada.go("/accounts/password/reset/")
    ada.can_be_used("password reset")
    ada.go("/api/v1/docs")
    ada.comes_to("/accounts/login/?next=%2Fapi%2Fv1%2Fdocs")
    ada.can_be_used("sign-in")
    ada.sign_in("ada")
    ada.page.wait_for_url("**/api/v1/docs")


def invites_to_a_class(ada: Someone, bob: Someone, mails: Mailbox) -> None:
    ada.go("/")
    # This server has no containers.
    expect(ada.at("shared-rights")).to_contain_text("does not isolate its users")
    ada.can_be_used("start page with a warning")
    ada.menu("Groups")
    ada.type("New group", "Robotics 1")
    ada.page.keyboard.press("Enter")
    ada.press("button", "Make an invitation link")
    link = ada.page.get_by_label("Invitation link").input_value()
    ada.can_be_used("groups")
    ada.page.keyboard.press("Escape")
    bob.go(link)
    bob.can_be_used("invitation")
    bob.press("link", "Make an account")
    bob.can_be_used("sign-up")
    bob.type("Username", "bob")
    bob.type("Email", "bob@example.org")
    bob.type("Password", PASSWORD)
    bob.type("Password (again)", PASSWORD)
    bob.page.keyboard.press("Enter")
    bob.comes_to("/accounts/confirm-email/")
    bob.can_be_used("address to be confirmed")
    bob.go(mails.link_for("bob@example.org"))
    bob.can_be_used("confirmation")
    bob.press("button", "Confirm")
    bob.comes_to("/accounts/login/")
    bob.sign_in("bob")
    expect(bob.at("projects")).to_be_attached()


def shares_a_project_and_gives_it_away(ada: Someone, bob: Someone, guest: Someone) -> None:
    ada.new_from("laser_bump_and_go")
    ada.at("share").click()
    dialog = ada.page.get_by_role("dialog")
    ada.type("Share with", "bob")
    ada.press("combobox", "What they may do")
    ada.press("option", "Can edit")
    dialog.get_by_role("button", name="Share", exact=True).click()
    # His row moves the rows below it: a click on its way would miss.
    expect(dialog.get_by_role("button", name="Make bob the owner")).to_be_visible()
    ada.press("button", "Make a link")
    guest.go(ada.page.get_by_label("Read-only link").input_value())
    expect(guest.at("read-only")).to_be_visible()
    run = guest.page.get_by_role("button", name="Run", exact=True).first
    expect(run).to_have_attribute("aria-disabled", "true")
    run.hover()
    expect(guest.page.get_by_role("tooltip")).to_contain_text("needs an account")
    ada.press("button", "Make bob the owner")
    ada.can_be_used("sharing")
    ada.press("button", "Keep it")
    expect(dialog.get_by_role("alert")).to_have_count(0)
    ada.press("button", "Make bob the owner")
    dialog.get_by_role("alert").get_by_role("button", name="Make bob the owner").click()
    expect(dialog).to_have_count(0)
    expect(ada.at("share")).to_have_count(0)
    bob.go(ada.page.url)
    expect(bob.at("share")).to_be_visible()


def announces_an_upgrade(ada: Someone, bob: Someone) -> None:
    for page in ("accounts/user", "accounts/auditentry", "mail"):
        ada.go(f"/admin/{page}/")
        ada.can_be_used(page)
    ada.go("/admin/executor_sessions/session/")
    ada.can_be_used("sessions")
    ada.page.get_by_placeholder("Back at 15:00.").fill("Back at 15:00.")
    ada.press("button", "Let no robot start")
    expect(bob.page.get_by_text("Back at 15:00.").first).to_be_visible()
    ada.press("button", "Let robots start again")


def takes_a_second_factor(ada: Someone) -> None:
    ada.go("/accounts/2fa/totp/activate/")
    if "reauthenticate" in ada.page.url:  # after five minutes, which a busy machine may need
        ada.type("Password", PASSWORD)
        ada.page.keyboard.press("Enter")
        ada.page.wait_for_url("**/totp/activate/")
    ada.can_be_used("second factor")
    ada.type("Authenticator code", code_of(ada.page.get_by_label("Authenticator secret").input_value()))
    ada.page.keyboard.press("Enter")
    ada.page.wait_for_url("**/recovery-codes/**")
    ada.can_be_used("recovery codes")
    ada.go("/accounts/logout/")
    ada.can_be_used("sign-out")
    ada.press("button", "Sign Out")
    ada.comes_to("/accounts/login/")
    ada.sign_in("ada")
    ada.comes_to("/accounts/2fa/authenticate/")
    ada.can_be_used("code")


def forgets_the_password(bob: Someone, mails: Mailbox) -> None:
    bob.go("/accounts/logout/")
    bob.press("button", "Sign Out")
    bob.go("/accounts/password/reset/")
    bob.type("Email", "bob@example.org")
    bob.page.keyboard.press("Enter")
    bob.comes_to("/accounts/password/reset/done/")
    bob.can_be_used("mail on its way")
    bob.go(mails.link_for("bob@example.org"))
    bob.can_be_used("new password")
    bob.type("New Password", ANOTHER)
    bob.type("New Password (again)", ANOTHER)
    bob.page.keyboard.press("Enter")
    bob.comes_to("/accounts/password/reset/key/done/")
    bob.go("/accounts/login/")
    bob.sign_in("bob")
    expect(bob.page.get_by_text("not correct")).to_be_visible()
    bob.go("/accounts/login/")
    bob.sign_in("bob", ANOTHER)
    expect(bob.at("projects")).to_be_attached()


def takes_everything_along_and_goes(bob: Someone) -> None:
    bob.go("/")
    bob.menu("Storage and data")
    with bob.page.expect_download() as download:
        bob.press("link", "Download everything")
    assert download.value.suggested_filename == "bob.zip"
    bob.type("Type your user name to delete the account", "bob")
    bob.can_be_used("room and data")
    bob.press("button", "Delete the account permanently")
    bob.comes_to("/accounts/login/")
    bob.sign_in("bob", ANOTHER)
    expect(bob.page.get_by_text("not correct")).to_be_visible()
