"""The guard and the security headers, attacked from outside."""

from __future__ import annotations

import pytest
from django.test import Client

from backend.core import guard

HOST = "127.0.0.1:8000"
ORIGIN = f"http://{HOST}"


@pytest.fixture
def stranger(db):
    return Client(HTTP_HOST=HOST)


@pytest.fixture
def browser(stranger):
    stranger.cookies[guard.cookie_name(HOST)] = guard.keys().cookie_value
    return stranger


def test_the_link_becomes_a_cookie_that_scripts_and_other_sites_cannot_use(stranger):
    response = stranger.get("/", {"token": guard.keys().token})
    cookie = response.cookies[guard.cookie_name(HOST)]
    assert (response.status_code, response.headers["Location"]) == (302, "/")
    assert cookie["httponly"]
    assert cookie["samesite"] == "Strict"
    assert cookie["path"] == "/"
    assert guard.keys().token not in cookie.value
    assert stranger.get("/api/v1/me").status_code == 200


def test_the_link_of_a_page_leads_to_it_and_to_no_other_host(stranger):
    token = {"token": guard.keys().token}
    assert stranger.get("/api/v1/me", token).status_code == 403
    page = stranger.get("/projects/p1", token | {"run": "r1"})
    assert (page.status_code, page["Location"]) == (302, "/projects/p1?run=r1")
    assert page.cookies
    assert stranger.get("/projects//evil.example/", token)["Location"] == "/projects//evil.example"
    assert stranger.get("//evil.example/projects/", token)["Location"] == "/projects"


def test_a_wrong_token_sets_no_cookie(stranger):
    response = stranger.get("/", {"token": "wrong"})
    assert response.status_code == 403
    assert not response.cookies


def test_a_cookie_chosen_by_someone_else_is_not_taken_over(stranger):
    stranger.cookies[guard.cookie_name(HOST)] = "fixed-by-the-attacker"
    assert stranger.get("/api/v1/me").status_code == 403
    stranger.get("/", {"token": guard.keys().token})
    assert stranger.cookies[guard.cookie_name(HOST)].value == guard.keys().cookie_value


def test_a_page_without_cookie_says_where_the_link_is(stranger):
    response = stranger.get("/", headers={"Accept": "text/html"})
    assert response.status_code == 403
    assert b"in the terminal" in response.content
    assert b"<script" not in response.content


def test_the_api_without_cookie_answers_with_a_problem(stranger):
    response = stranger.get("/api/v1/projects", headers={"Accept": "text/html"})
    problem = response.json()
    assert response.headers["Content-Type"] == "application/problem+json"
    assert (problem["status"], problem["code"]) == (403, "link_required")
    assert "terminal" in problem["hint"]


def test_a_rebound_host_gets_nothing(browser):
    response = browser.get("/api/v1/projects", headers={"Host": "rebound.example:8000"})
    assert response.status_code == 421


def test_the_token_does_not_work_under_a_rebound_host(stranger):
    response = stranger.get("/", {"token": guard.keys().token}, headers={"Host": "rebound.example"})
    assert response.status_code == 421
    assert not response.cookies


def test_a_form_of_another_site_changes_nothing(browser):
    response = browser.post(
        "/api/v1/projects", "name=x", content_type="application/x-www-form-urlencoded",
        headers={"Origin": "http://evil.example"},
    )  # fmt: skip
    assert response.status_code == 403
    assert browser.get("/api/v1/projects").json()["items"] == []


@pytest.mark.parametrize(
    "kind", ["application/x-www-form-urlencoded", "text/plain", "multipart/form-data; boundary=x"]
)
def test_only_json_is_read_which_no_form_can_send(browser, kind):
    response = browser.generic("POST", "/api/v1/projects", b'{"name": "x"}', content_type=kind)
    assert response.status_code == 415


def test_an_upload_of_another_site_is_refused(browser):
    response = browser.post("/api/v1/projects/import", {"file": "x"}, headers={"Origin": "null"})
    assert response.status_code == 403


def test_a_program_may_show_the_token_instead(stranger):
    headers = {"Authorization": f"Bearer {guard.keys().token}"}
    assert stranger.get("/api/v1/me", headers=headers).status_code == 200
    assert stranger.get("/api/v1/me", headers={"Authorization": "Bearer x"}).status_code == 403


@pytest.mark.parametrize("path", ["/", "/api/v1/me", "/api/v1/nothing", "/projects/0", "/nothing"])
def test_every_answer_carries_the_security_headers(browser, path):
    headers = browser.get(path).headers
    policy = dict(part.split(" ", 1) for part in headers["Content-Security-Policy"].split("; "))
    assert policy["script-src"] == policy["connect-src"] == "'self'"
    assert policy["frame-ancestors"] == "'none'"
    assert policy["object-src"] == "'none'"
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Referrer-Policy"] == "no-referrer"


def test_no_answer_invites_other_origins(browser):
    for path in ("/", "/api/v1/me", "/favicon.ico"):
        assert "Access-Control-Allow-Origin" not in browser.get(path).headers


@pytest.mark.parametrize(
    "path", ["/../pyproject.toml", "/..%2f..%2fetc/passwd", "/assets/../../pyproject.toml", "/%2e%2e/x"]
)
def test_the_front_end_hands_out_nothing_beside_itself(browser, path):
    assert browser.get(path).status_code in {400, 404}


def test_browsers_are_asked_to_stay_with_tls_where_there_is_some(browser, settings_of):
    name = "Strict-Transport-Security"
    assert name not in browser.get("/").headers
    settings_of(public_url="https://bt.example.org")
    assert browser.get("/").headers[name] == "max-age=31536000"
    settings_of(public_url="https://bt.example.org", hsts_days=0)
    assert name not in browser.get("/").headers
