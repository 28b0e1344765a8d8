"""The runs of a user in all projects."""

from __future__ import annotations

import io
import json
import zipfile
from uuid import uuid4

import pytest
from django.utils import timezone

from backend.accounts.writes import delete_account
from backend.projects.sharing import memberships, transfer
from backend.runs import mine
from backend.runs.models import Run, RunPart
from tests.backend.runs.conftest import SAMPLE, keep

pytestmark = pytest.mark.usefixtures("manager")


def listed(by):
    return [
        (run["name"], run["project_name"], run["may_open"])
        for run in by.client.get("/api/v1/runs").json()["items"]
    ]


def delete(by, run):
    return by.client.delete(f"/api/v1/runs/{run['id']}").status_code


def lose(people):
    memberships.unshare_with_person(people.project.id, "viewer", acting_user=people.owner.user)


def test_the_start_page_lists_the_runs_of_the_user_alone(people):
    keep(people.owner, people.project, name="mine")
    keep(people.viewer, people.project, name="theirs")
    assert listed(people.owner) == [("mine", "Robot", True)]
    assert listed(people.viewer) == [("theirs", "Robot", True)]
    assert listed(people.other) == []


def test_a_keeper_who_lost_the_project_can_delete_the_run_and_nothing_else(people):
    run = keep(people.viewer, people.project, name="theirs").json()
    lose(people)
    assert listed(people.viewer) == [("theirs", "", False)]
    address = f"/api/v1/projects/{people.project.id}/runs/{run['id']}"
    assert [people.viewer.client.get(f"{address}{part}").status_code for part in ("", "/recording")] == [
        404
    ] * 2
    assert delete(people.owner, run) == 404
    assert delete(people.viewer, run) == 204
    assert Run.objects.count() == 0


def test_the_owner_deletes_the_run_of_a_keeper_who_lost_the_project(people):
    run = keep(people.viewer, people.project).json()
    lose(people)
    address = f"/api/v1/projects/{people.project.id}/runs/{run['id']}"
    assert people.owner.client.delete(address).status_code == 204
    assert listed(people.viewer) == []


def test_runs_of_a_deleted_project_can_be_deleted_but_not_opened(people):
    run = keep(people.owner, people.project, name="mine").json()
    people.project.deleted_at = timezone.now()
    people.project.save()
    assert listed(people.owner) == [("mine", "", False)]
    assert delete(people.owner, run) == 204
    assert people.owner.client.delete(f"/api/v1/runs/{uuid4()}").status_code == 404


def test_the_usage_counts_runs_with_their_quota(people):
    keep(people.viewer, people.project)
    found = people.viewer.client.get("/api/v1/me/usage").json()
    assert (found["runs"], found["run_bytes"], found["max_run_bytes"] > 10**9) == (1, len(SAMPLE), True)
    assert (found["projects"], found["bytes"]) == (0, 0)
    assert people.owner.client.get("/api/v1/me/usage").json()["runs"] == 0


def test_all_data_of_a_user_have_their_runs(people):
    run = keep(people.viewer, people.project, name="../a: b", note="Why?").json()
    keep(people.owner, people.project, name="not theirs")
    answer = people.viewer.client.get("/api/v1/me/data")
    with zipfile.ZipFile(io.BytesIO(answer.getvalue())) as archive:
        (told,) = json.loads(archive.read("account.json"))["runs"]
        assert (told["name"], told["note"], told["project__name"]) == ("../a: b", "Why?", "Robot")
        (path,) = [name for name in archive.namelist() if name.startswith("runs/")]
        assert path == f"runs/..-a- b ({run['id']}).mcap"
        assert archive.read(path) == SAMPLE
    assert mine.data_of(None, user=people.other.user).files == []


def test_an_account_takes_its_runs_along_and_a_transferred_project_keeps_them(people):
    keep(people.editor, people.project, name="editor's")
    keep(people.owner, people.project, name="owner's")
    transfer.transfer_project(people.project.id, "editor", acting_user=people.owner.user)
    assert listed(people.owner) == [("owner's", "Robot", True)]
    seen = people.editor.client.get(f"/api/v1/projects/{people.project.id}/runs").json()["items"]
    assert {run["name"] for run in seen} == {"editor's", "owner's"}
    delete_account(people.owner.user)
    assert list(Run.objects.values_list("name", flat=True)) == ["editor's"]
    assert RunPart.objects.count() == len({part.run_id for part in RunPart.objects.all()}) == 1
