"""Stored runs as users keep, see, change and download them."""

from __future__ import annotations

import hashlib

import pytest

from backend.projects.choices import Role
from backend.projects.sharing import memberships
from backend.runs import views
from backend.runs.models import PART_BYTES, Run, RunPart
from backend.runs.views import Runs
from tests.backend.accounts.conftest import PUBLIC, Person
from tests.backend.runs.conftest import SAMPLE, keep

pytestmark = pytest.mark.usefixtures("manager")


def body(response):
    return response.getvalue()


def change(by, run, **values):
    address = f"/api/v1/projects/{run['project']}/runs/{run['id']}"
    return by.client.patch(address, data=values, content_type="application/json")


def seen(by, project):
    return [run["name"] for run in by.client.get(f"/api/v1/projects/{project.id}/runs").json()["items"]]


def test_a_kept_run_is_listed_with_what_the_server_found_out(people):
    answer = keep(people.editor, people.project, note="The crate fell.")
    assert answer.status_code == 201
    run = answer.json()
    assert (run["length_s"], run["result"], run["has_thumbnail"]) == (1.0, "running", True)
    assert (run["size"], run["keeper"], run["recorded_as"]) == (len(SAMPLE), "editor", "a1")
    assert (run["is_pinned"], run["is_shared"], run["may_manage"], run["is_last"]) == (
        False,
        False,
        True,
        False,
    )
    assert seen(people.editor, people.project) == ["Kept"]
    stored = Run.objects.get(id=run["id"])
    assert stored.sha256 == hashlib.sha256(SAMPLE).hexdigest()
    assert RunPart.objects.filter(run=stored).count() == -(-len(SAMPLE) // PART_BYTES)


def test_a_run_is_seen_by_its_keeper_and_the_owner_and_once_shared_by_all_who_may_read(people):
    run = keep(people.editor, people.project).json() | {"project": people.project.id}
    assert seen(people.owner, people.project) == ["Kept"]
    assert seen(people.viewer, people.project) == []
    assert change(people.editor, run, is_shared=True).status_code == 200
    assert seen(people.viewer, people.project) == ["Kept"]
    assert not people.viewer.client.get(f"/api/v1/projects/{people.project.id}/runs").json()["items"][0][
        "may_manage"
    ]
    answer = change(people.viewer, run, name="Mine")
    assert (answer.status_code, answer.json()["code"]) == (403, "role_too_low")
    assert "kept by editor" in answer.json()["detail"]


def test_a_viewer_keeps_runs_of_their_own_and_cannot_share_them(people):
    run = keep(people.viewer, people.project).json() | {"project": people.project.id}
    assert change(people.viewer, run, name="Better", note="n", is_pinned=True).json()["name"] == "Better"
    assert change(people.viewer, run, is_shared=True).json()["code"] == "role_too_low"
    assert seen(people.editor, people.project) == []


def test_a_guest_with_a_link_sees_shared_runs_only_and_downloads_them(people):
    shared = keep(people.editor, people.project).json() | {"project": people.project.id}
    own = keep(people.owner, people.project, name="The owner's").json()
    assert change(people.editor, shared, is_shared=True).status_code == 200
    owner, guest = people.owner.user, Person()
    memberships.make_link(people.project.id, acting_user=owner, days=None)
    (link,) = memberships.shares(people.project)["links"]
    opened = guest.page(f"{link['url'].partition(PUBLIC)[2]}?run={shared['id']}&t=1.5")
    assert (opened.status_code, opened["Location"].endswith(f"?run={shared['id']}&t=1.5")) == (302, True)
    assert seen(guest, people.project) == ["Kept"]
    runs = f"/api/v1/projects/{people.project.id}/runs"
    assert body(guest.client.get(f"{runs}/{shared['id']}/recording")) == SAMPLE
    for hidden in (f"{runs}/{own['id']}", f"{runs}/{own['id']}/recording"):
        assert guest.client.get(hidden).status_code == 404
    assert change(people.editor, shared, is_shared=False).status_code == 200
    assert guest.client.get(f"{runs}/{shared['id']}/recording").status_code == 404


def test_a_deleted_run_and_a_deleted_project_leave_nothing(people):
    run = keep(people.owner, people.project).json()
    address = f"/api/v1/projects/{people.project.id}/runs/{run['id']}"
    assert people.owner.client.delete(address).status_code == 204
    assert people.owner.client.get(address).status_code == 404
    keep(people.owner, people.project)
    people.project.delete()
    assert (Run.objects.count(), RunPart.objects.count()) == (0, 0)


@pytest.mark.parametrize(
    ("asked", "field"),
    [
        ({"run": "../x"}, "run"),
        ({"name": ""}, "name"),
        ({"name": "x" * 101}, "name"),
        ({"result": "success"}, "result"),
    ],
)
def test_values_that_cannot_be_are_named(people, asked, field):
    answer = keep(people.owner, people.project, **asked)
    assert (answer.status_code, answer.json()["field"]) == (422, field)
    assert Run.objects.count() == 0


def test_the_recording_is_downloaded_as_a_whole_and_in_ranges(people):
    run = keep(people.owner, people.project, name="Kiste „1“").json()
    address = f"/api/v1/projects/{people.project.id}/runs/{run['id']}/recording"
    whole = people.owner.client.get(address)
    assert (whole.status_code, body(whole)) == (200, SAMPLE)
    assert whole["X-Content-Type-Options"] == "nosniff"
    assert whole["Content-Disposition"].startswith("attachment; ")
    assert "Kiste%20%E2%80%9E1%E2%80%9C.mcap" in whole["Content-Disposition"]
    for begin, end in ((0, 10), (5, len(SAMPLE)), (len(SAMPLE) - 7, len(SAMPLE))):
        part = people.owner.client.get(address, headers={"Range": f"bytes={begin}-{end - 1}"})
        assert (part.status_code, body(part)) == (206, SAMPLE[begin:end])
        assert part["Content-Range"] == f"bytes {begin}-{end - 1}/{len(SAMPLE)}"
    for tag, expected in ((whole["ETag"], SAMPLE[:10]), ('"old"', SAMPLE)):
        answer = people.owner.client.get(address, headers={"Range": "bytes=0-9", "If-Range": tag})
        assert body(answer) == expected
    assert people.owner.client.get(address, headers={"If-None-Match": whole["ETag"]}).status_code == 304
    beyond = people.owner.client.get(address, headers={"Range": f"bytes={len(SAMPLE)}-"})
    assert (beyond.status_code, beyond.json()["code"]) == (416, "bad_range")
    assert beyond["Content-Range"] == f"bytes */{len(SAMPLE)}"


def test_a_run_has_a_small_picture_that_can_do_no_harm(people):
    run = keep(people.owner, people.project).json()
    address = f"/api/v1/projects/{people.project.id}/runs/{run['id']}/thumbnail"
    answer = people.owner.client.get(address)
    assert (answer.status_code, answer["Content-Type"]) == (200, "image/jpeg")
    assert answer.content.startswith(b"\xff\xd8\xff")
    assert answer["X-Content-Type-Options"] == "nosniff"
    assert "sandbox" in answer["Content-Security-Policy"]
    assert people.viewer.client.get(address).status_code == 404
    Run.objects.update(thumbnail_type="")
    assert people.owner.client.get(address).status_code == 404


def test_keeping_a_run_is_an_expensive_call():
    assert Runs.expensive == ("POST",)


def test_only_its_keeper_shares_a_run_and_takes_it_back_also_as_a_viewer(people):
    run = keep(people.editor, people.project).json() | {"project": people.project.id}
    answer = change(people.owner, run, is_shared=True)
    assert (answer.status_code, answer.json()["code"]) == (403, "role_too_low")
    assert change(people.editor, run, is_shared=True).status_code == 200
    owner = people.owner.user
    memberships.share_with_person(people.project.id, "editor", Role.VIEWER, acting_user=owner)
    assert change(people.editor, run, is_shared=False).status_code == 200
    assert change(people.editor, run, is_shared=True).status_code == 403


def test_a_misspelt_field_is_an_error(people):
    run = keep(people.owner, people.project).json() | {"project": people.project.id}
    answer = change(people.owner, run, is_pined=True)
    assert (answer.status_code, answer.json()["field"]) == (422, "is_pined")


def test_a_user_downloads_one_whole_recording_at_a_time_and_a_long_range_comes_in_parts(people, monkeypatch):
    run = keep(people.owner, people.project).json()
    address = f"/api/v1/projects/{people.project.id}/runs/{run['id']}/recording"
    first = people.owner.client.get(address)
    second = people.owner.client.get(address)
    assert (second.status_code, second.json()["code"]) == (429, "throttled")
    assert body(first) == SAMPLE
    assert body(people.owner.client.get(address)) == SAMPLE
    monkeypatch.setattr(views, "MOST_PART_BYTES", 1000)
    part = people.owner.client.get(address, headers={"Range": "bytes=5-"})
    assert part["Content-Range"] == f"bytes 5-1004/{len(SAMPLE)}"
    assert body(part) == SAMPLE[5:1005]
