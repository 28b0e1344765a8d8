"""Sign-in and sign-up through the pages: who is admitted or refused, and what is logged."""

from __future__ import annotations

import time

import pytest
from django.conf import settings
from django.core import mail
from django.test import override_settings

from backend.accounts import invitations, links
from backend.accounts.models import AuditEntry, User
from backend.accounts.sign_in import passwords
from backend.accounts.writes import create_account
from tests.backend.accounts.conftest import PASSWORD, PUBLIC, Person

NEW = "Another-horse-7"


def log():
    return list(AuditEntry.objects.order_by("id").values_list("actor_name", "action"))


def test_name_or_address_with_the_password_open_the_door(team):
    create_account("ada", email="ada@example.org", password=PASSWORD)
    for name in ("ada", "ADA@example.org"):
        browser = Person()
        assert browser.sign_in(name)["Location"] == "/"
        assert browser.get("me")["user"] == "ada"
    assert log()[-1] == ("ada", "login")


def test_a_wrong_password_does_not_and_is_noted(team):
    create_account("ada", email="", password=PASSWORD)
    browser = Person()
    browser.sign_in("ada", "wrong", expect=200)
    assert browser.problem("GET", "me", 401) == "sign_in_required"
    assert ("ada", "login.failed") in log()


def test_guessing_passwords_is_slowed_down(team):
    create_account("ada", email="", password=PASSWORD)
    browser = Person()
    answers = [browser.sign_in("ada", "wrong", expect=200).content for _ in range(5)]
    refused = browser.sign_in("ada", PASSWORD, expect=200).content
    assert b"Too many failed" not in answers[0]
    assert b"Too many failed" in refused
    assert browser.problem("GET", "me", 401) == "sign_in_required"


def test_the_session_is_another_one_after_signing_in(team):
    create_account("ada", email="", password=PASSWORD)
    browser = Person()
    browser.client.get("/accounts/login/")
    fixed = "f" * 32
    browser.client.cookies[settings.SESSION_COOKIE_NAME] = fixed
    browser.sign_in("ada")
    assert browser.client.cookies[settings.SESSION_COOKIE_NAME].value != fixed
    attacker = Person()
    attacker.client.cookies[settings.SESSION_COOKIE_NAME] = fixed
    assert attacker.problem("GET", "me", 401) == "sign_in_required"


def test_a_deactivated_account_is_out_at_once(person):
    ada = person("ada")
    User.objects.filter(username="ada").update(is_active=False)
    assert ada.problem("GET", "me", 401) == "sign_in_required"


def test_pages_ask_to_sign_in_and_come_back(stranger):
    there = "/projects/00000000-0000-4000-8000-000000000000"
    assert stranger.page("/")["Location"] == "/accounts/login/"
    assert stranger.page(there)["Location"] == "/accounts/login/?next=" + there.replace("/", "%2F")


def test_signing_in_leads_to_no_other_site(team):
    create_account("ada", email="", password=PASSWORD)
    for evil in ("https://evil.example/", "//evil.example/", "/\\evil.example", "javascript:alert(1)"):
        browser = Person()
        answer = browser.form("/accounts/login/", login="ada", password=PASSWORD, next=evil)
        assert answer["Location"] == "/"


def test_another_site_can_neither_write_nor_sign_out(person):
    ada = person("ada")
    ada.client.defaults["HTTP_ORIGIN"] = "https://evil.example"
    assert ada.problem("POST", "projects", 403, {"name": "x"}) == "origin_refused"
    assert ada.client.post("/accounts/logout/").status_code == 403
    del ada.client.defaults["HTTP_ORIGIN"]
    assert ada.client.post("/accounts/logout/").status_code == 403  # no token of a form
    assert ada.get("me")["user"] == "ada"


def test_only_the_servers_own_name_is_answered(person):
    ada = person("ada")
    ada.client.defaults |= {"HTTP_HOST": "rebound.example", "HTTP_ORIGIN": "http://rebound.example"}
    assert ada.problem("GET", "me", 421) == "host_refused"


def test_the_token_of_localhost_opens_nothing_here(stranger):
    from backend.core import guard

    token = guard.keys().token
    answer = stranger.client.get("/api/v1/me", headers={"Authorization": f"Bearer {token}"})
    assert answer.status_code == 401
    assert stranger.page(f"/?token={token}")["Location"] == "/accounts/login/"


def test_registration_is_closed(stranger):
    page = stranger.page("/accounts/signup/").content.decode()
    assert "By invitation only" in page
    assert "password1" not in page


def test_registration_can_be_open_for_some_domains(team, settings_of):
    settings_of(registration="open", allowed_email_domains='["Uni.Example"]')
    fields = {"username": "eve", "password1": NEW, "password2": NEW}
    browser = Person()
    refused = browser.form("/accounts/signup/", email="eve@else.example", expect=200, **fields)
    assert b"uni.example" in refused.content
    browser.form("/accounts/signup/", email="eve@uni.example", **fields)
    assert browser.get("me")["role"] == "user"


def test_an_invitation_lets_people_in_as_often_as_it_says(person):
    teacher = person("tina", is_teacher=True)
    group = teacher.post("groups", {"name": "Robotics 1"}, expect=201)
    link = teacher.post(f"groups/{group['id']}/invitations", {"max_uses": 1, "days": 3}, expect=201)["url"]
    path = link.partition(PUBLIC)[2]
    browser = Person()
    assert b"Robotics 1" in browser.page(path).content
    browser.form("/accounts/signup/", username="sam", email="sam@x.example", password1=NEW, password2=NEW)
    assert [group["name"] for group in browser.get("groups")["items"]] == ["Robotics 1"]
    assert browser.get("groups")["items"][0]["members"] == []  # only the teacher sees the members
    assert [m["username"] for m in teacher.get(f"groups/{group['id']}")["members"]] == ["sam"]
    assert Person().page(path).status_code == 404
    assert ("sam", "invitation.accept") in log()


def test_someone_with_an_account_joins_with_a_button(person):
    teacher, sam = person("tina", is_teacher=True), person("sam")
    group = teacher.post("groups", {"name": "Robotics"}, expect=201)
    link = teacher.post(f"groups/{group['id']}/invitations", expect=201)["url"]
    assert sam.form(link.partition(PUBLIC)[2])["Location"] == "/"
    assert sam.get(f"groups/{group['id']}")["name"] == "Robotics"


def test_a_forged_or_revoked_invitation_is_dead(person):
    teacher = person("tina", is_teacher=True)
    made = invitations.invite(acting_user=teacher.user, group=None, days=1, max_uses=1)
    token = links.token_of("join", made.id)
    assert Person().page(f"/join/{token[:-1]}x").status_code == 404
    assert Person().page(f"/shared/{token}").status_code == 404  # a link of another kind
    assert Person().page(f"/join/{token}").status_code == 200
    teacher.delete(f"invitations/{made.id}")
    assert Person().page(f"/join/{token}").status_code == 404


def test_only_teachers_invite(person):
    sam = person("sam")
    assert sam.problem("POST", "groups", 403, {"name": "Mine"}) == "teacher_required"


def test_a_link_sets_a_new_password_once(person):
    ada = person("ada")
    path = passwords.link(ada.user).partition(PUBLIC)[2]
    browser = Person()
    form = browser.page(path)["Location"]
    browser.form(form, password1=NEW, password2=NEW)
    assert Person().sign_in("ada", NEW)["Location"] == "/"
    assert Person().page(path).status_code == 200  # the page says that the link is used up
    assert ("ada", "password.reset") in log()
    assert ada.problem("GET", "me", 401) == "sign_in_required"  # old sessions have ended


def test_a_forgotten_password_is_reset_by_mail_and_strangers_learn_nothing(person, settings_of):
    person("ada")
    settings_of(smtp_url="smtp://mail.example", mail_from="bt@example.org")
    with override_settings(EMAIL_BACKEND="django.core.mail.backends.locmem.EmailBackend"):
        known = Person().form("/accounts/password/reset/", email="ada@example.org")
        unknown = Person().form("/accounts/password/reset/", email="nobody@example.org")
    assert known["Location"] == unknown["Location"]
    assert f"http://{PUBLIC}/accounts/password/reset/key/" in mail.outbox[0].body
    assert "/password/reset/key/" not in mail.outbox[-1].body


@pytest.mark.parametrize("step", [0, 1])
def test_a_second_factor_is_asked_for(person, django_capture_on_commit_callbacks, step):
    from allauth.mfa.totp.internal.auth import format_hotp_value, hotp_value

    person("ada")
    browser = Person()
    browser.sign_in("ada")
    page = browser.page("/accounts/2fa/totp/activate/")
    if page.status_code == 302:
        browser.form(page["Location"], password=PASSWORD)
        page = browser.page("/accounts/2fa/totp/activate/")
    secret = page.context["form"].secret
    # The clock of the user who types may be ahead of ours.
    code = format_hotp_value(hotp_value(secret, int(time.time()) // 30 + step))
    token = browser.client.cookies[settings.CSRF_COOKIE_NAME].value
    sent = {"code": code, "csrfmiddlewaretoken": token}
    with django_capture_on_commit_callbacks(execute=True):
        assert browser.client.post("/accounts/2fa/totp/activate/", sent).status_code == 302
    second = Person()
    assert "2fa" in second.sign_in("ada")["Location"]
    assert second.problem("GET", "me", 401) == "sign_in_required"
    assert ("ada", "second_factor.add") in log()


def test_pages_speak_the_browsers_language(stranger):
    page = stranger.client.get("/accounts/login/", headers={"Accept-Language": "es"}).content.decode()
    assert "Iniciar sesión" in page
    assert '<html lang="es"' in page


def test_pages_have_no_inline_scripts_and_a_policy(stranger):
    for path in ("/accounts/login/", "/accounts/signup/", "/accounts/password/reset/"):
        answer = stranger.page(path)
        assert "script-src 'self'" in answer["Content-Security-Policy"]
        assert answer["Referrer-Policy"] == "same-origin"
        assert b"<script>" not in answer.content
        assert b"onclick" not in answer.content
