"""Sharing as users see it: what a link shows, when it ends, what is logged, and the end of an account."""

from __future__ import annotations

import io
import json
import zipfile

from backend.accounts.models import AuditEntry, User
from tests.backend.accounts.conftest import PUBLIC, Person


def project_of(owner, name="Robot"):
    return owner.post("projects", {"name": name}, expect=201)["id"]


def test_a_link_opens_one_project_until_it_is_revoked(person):
    owner = person("olga")
    one, two = project_of(owner), project_of(owner, "Other")
    link = owner.post(f"projects/{one}/shares/links", {}, expect=201)["links"][0]
    guest = Person()
    assert guest.page(link["url"].partition(PUBLIC)[2])["Location"] == f"/projects/{one}"
    assert guest.get(f"projects/{one}")["role"] == "viewer"
    assert guest.get("me")["role"] == "guest"
    guest.get(f"projects/{two}", expect=404)
    owner.delete(f"projects/{one}/shares/links/{link['id']}")
    guest.get(f"projects/{one}", expect=404)


def test_a_link_leads_to_a_moment_of_a_run(person):
    owner = person("olga")
    project = project_of(owner)
    link = owner.post(f"projects/{project}/shares/links", {}, expect=201)["links"][0]
    path = link["url"].partition(PUBLIC)[2]
    answer = Person().page(f"{path}?run=0f6a&t=2.5&next=//elsewhere")
    assert answer["Location"] == f"/projects/{project}?run=0f6a&t=2.5"
    assert Person().page(f"{path}?run=%0d%0aX:1")["Location"] == f"/projects/{project}?run=%0D%0AX%3A1"


def test_sharing_by_address_lists_the_project_with_its_owner(person):
    owner, friend = person("olga"), person("fred")
    one = project_of(owner)
    owner.post(f"projects/{one}/shares", {"name": "FRED@example.org", "role": "editor"})
    listed = friend.get("projects")["items"]
    assert [(row["name"], row["owner"], row["role"]) for row in listed] == [("Robot", "olga", "editor")]
    friend.save(one, {"path": "a.txt", "base_revision": 0, "content": "mine"})
    assert owner.get(f"projects/{one}/revisions")["items"][0]["author"] == "fred"
    friend.delete(f"projects/{one}/shares/people/fred")
    friend.get(f"projects/{one}", expect=404)


def test_a_stale_list_of_shares_is_not_overwritten(person):
    owner = person("olga")
    person("fred")
    one = project_of(owner)
    owner.get(f"projects/{one}/shares")
    tag = owner.response["ETag"]
    owner.post(f"projects/{one}/shares", {"name": "fred", "role": "viewer"}, **{"If-Match": tag})
    owner.post(f"projects/{one}/shares/links", {}, expect=412, **{"If-Match": tag})


def test_two_of_one_name_can_be_shared_with_one_person(person):
    owner, friend = person("olga"), person("fred")
    project_of(friend)
    owner.post(f"projects/{project_of(owner)}/shares", {"name": "fred", "role": "viewer"})
    assert [row["owner"] for row in friend.get("projects?sort=created_at")["items"]] == ["fred", "olga"]


def test_the_log_says_who_did_what(person):
    owner = person("olga")
    person("fred")
    one = project_of(owner)
    owner.post(f"projects/{one}/shares", {"name": "fred", "role": "viewer"})
    owner.delete(f"projects/{one}")
    rows = AuditEntry.objects.filter(subject_id=one).order_by("id")
    assert [(row.actor_name, row.action) for row in rows] == [
        ("olga", "project.create"),
        ("olga", "project.share"),
        ("olga", "project.delete"),
    ]
    assert {row.address for row in rows} == {"127.0.0.1"}


def test_an_address_is_believed_from_as_many_proxies_as_are_said(person, settings_of):
    settings_of(proxy_hops=1)
    owner = person("olga")
    owner.client.defaults["HTTP_X_FORWARDED_FOR"] = "6.6.6.6, 192.0.2.7"
    project_of(owner)
    assert AuditEntry.objects.filter(action="project.create").get().address == "192.0.2.7"


def test_a_project_gets_another_owner_with_its_history(person):
    owner, friend, other = person("olga"), person("fred"), person("otto")
    one = project_of(owner)
    project_of(friend)
    assert owner.problem("POST", f"projects/{one}/transfer", 422, {"name": "otto"}) == "invalid_input"
    owner.post(f"projects/{one}/shares", {"name": "fred", "role": "editor"})
    owner.post(f"projects/{one}/shares", {"name": "otto", "role": "viewer"})
    assert owner.problem("POST", f"projects/{one}/transfer", 422, {"name": "otto"}) == "invalid_input"
    shares = owner.post(f"projects/{one}/transfer", {"name": "fred@example.org"})
    assert shares["owner"]["username"] == "fred"
    assert [(p["username"], p["role"]) for p in shares["people"]] == [("olga", "editor"), ("otto", "viewer")]
    # Fred had a project of this name; the project's own file has the new name, too.
    found = owner.get(f"projects/{one}")
    assert (found["name"], found["role"], found["owner"]) == ("Robot 2", "editor", "fred")
    assert found["settings"]["name"] == "Robot 2"
    assert friend.get(f"projects/{one}/revisions")["items"][-1]["author"] == "olga"
    assert owner.problem("DELETE", f"projects/{one}", 403) == "role_too_low"
    friend.delete(f"projects/{one}")
    assert other.problem("GET", f"projects/{one}", 404) == "not_found"


def test_nobody_is_given_more_than_they_have_room_for(person):
    owner, friend = person("olga"), person("fred")
    one = project_of(owner)
    owner.post(f"projects/{one}/shares", {"name": "fred", "role": "editor"})
    User.objects.filter(username="fred").update(max_projects=0)
    assert owner.problem("POST", f"projects/{one}/transfer", 413, {"name": "fred"}) == "quota_exceeded"
    assert friend.get(f"projects/{one}")["owner"] == "olga"


def test_everything_kept_of_a_user_can_be_taken_away(person):
    owner = person("olga")
    one = project_of(owner)
    packed = zipfile.ZipFile(io.BytesIO(owner.get("me/data")))
    account = json.loads(packed.read("account.json"))
    assert account["email"] == "olga@example.org"
    assert "project.create" in {row["action"] for row in account["log"]}
    assert f"projects/Robot ({one}).zip" in packed.namelist()


def test_an_account_leaves_for_good_and_its_words_stay(person):
    owner, friend = person("olga"), person("fred")
    one = project_of(owner)
    project_of(friend, "Gone")
    owner.post(f"projects/{one}/shares", {"name": "fred", "role": "editor"})
    friend.save(one, {"path": "a.txt", "base_revision": 0, "content": "mine"})
    assert friend.problem("DELETE", "me/data", 422, {"username": "olga"}) == "invalid_input"
    friend.delete("me/data", body={"username": "fred"})
    assert not User.objects.filter(username="fred").exists()
    assert friend.problem("GET", "me", 401) == "sign_in_required"
    newest = owner.get(f"projects/{one}/revisions")["items"][0]
    assert (newest["author"], newest["files"][0]["path"]) == ("", "a.txt")


def test_the_last_administrator_stays(person):
    ada = person("ada", is_admin=True)
    assert ada.problem("DELETE", "me/data", 409, {"username": "ada"}) == "last_administrator"


def test_limits_of_one_user_come_before_the_servers(person):
    owner = person("olga")
    User.objects.filter(username="olga").update(max_projects=1)
    project_of(owner)
    assert owner.problem("POST", "projects", 413, {"name": "Second"}) == "quota_exceeded"


def test_expensive_calls_are_bounded(person, settings_of):
    settings_of(expensive_calls_per_minute=2)
    owner = person("olga")
    one = project_of(owner)
    for _ in range(2):
        owner.get(f"projects/{one}/export")
    owner.get(f"projects/{one}/export", expect=429)
    assert int(owner.response["Retry-After"]) > 0


def test_administrators_see_everybody_and_nobody_else_does(person):
    ada, olga = person("ada", is_admin=True), person("olga")
    project_of(olga)
    pages = ("", "accounts/user/", "accounts/auditentry/", "accounts/group/", "accounts/invitation/")
    more = ("projects/project/", "executor_sessions/session/", "mail/")
    for page in pages + more:
        assert ada.page(f"/admin/{page}").status_code == 200, page
        assert olga.page(f"/admin/{page}").status_code in {302, 403}, page
    form = {"action": "make_password_link", "_selected_action": str(olga.user.pk)}
    ada.form("/admin/accounts/user/", **form)
    assert b"/accounts/password/reset/key/" in ada.page("/admin/accounts/user/").content
    assert AuditEntry.objects.filter(action="password.link", subject="olga", actor_name="ada").exists()
