"""A last run is like every other in what belongs to its user: backup, personal data, deletion, transfer."""

from __future__ import annotations

import io
import json
import zipfile

import pytest
from django.contrib.auth import get_user_model
from django.core.management import call_command
from django.utils import timezone

from backend.accounts.writes import delete_account
from backend.cli.shared.backup_file import read_backup, write_backup
from backend.projects.models import Project
from backend.projects.sharing import transfer
from backend.runs import last, queries
from backend.runs.models import Run, RunPart
from backend.sessions.choices import SessionState
from backend.sessions.models import Session
from tests.backend.runs.test_last import folder, lasts, leave, session  # noqa: F401 - a fixture

pytestmark = pytest.mark.django_db(transaction=True)


def swept(people, folder, *names):  # noqa: F811
    for name in names:
        leave(folder, session(getattr(people, name), people.project))
    assert last.sweep() == len(names)


def recording(run):
    return b"".join(queries.parts(run, 0, run.size))


def test_a_last_run_is_in_a_backup_and_comes_back(people, folder):  # noqa: F811
    swept(people, folder, "viewer")
    before = Run.objects.get()
    values = {field.attname: getattr(before, field.attname) for field in Run._meta.concrete_fields}
    data = recording(before)
    file = io.BytesIO()
    assert write_backup(file)["runs.run"] == 1
    call_command("flush", interactive=False, verbosity=0)
    assert not Run.objects.exists()
    read_backup(file)
    after = Run.objects.get()
    assert {field.attname: getattr(after, field.attname) for field in Run._meta.concrete_fields} == values
    assert recording(after) == data
    assert lasts() == [("viewer", "a1")]
    # The next one replaces it, as it would have.
    user, project = get_user_model().objects.get(username="viewer"), Project.objects.get()
    ended = {"launcher": "process", "state": SessionState.ENDED, "created_at": timezone.now()}
    leave(folder, Session.objects.create(project=project, user=user, **ended), "b2")
    last.sweep()
    assert lasts() == [("viewer", "b2")]


def test_a_last_run_is_in_the_data_of_its_user_alone(people, folder):  # noqa: F811
    swept(people, folder, "viewer")
    run = Run.objects.get()
    answer = people.viewer.client.get("/api/v1/me/data")
    with zipfile.ZipFile(io.BytesIO(answer.getvalue())) as archive:
        assert len(json.loads(archive.read("account.json"))["runs"]) == 1
        (path,) = [name for name in archive.namelist() if name.startswith("runs/")]
        assert archive.read(path) == recording(run)
    answer = people.owner.client.get("/api/v1/me/data")
    with zipfile.ZipFile(io.BytesIO(answer.getvalue())) as archive:
        assert json.loads(archive.read("account.json"))["runs"] == []


def test_a_last_run_goes_by_itself_with_its_user_and_with_its_project(people, folder):  # noqa: F811
    swept(people, folder, "owner", "editor", "viewer")
    run = Run.objects.get(keeper=people.viewer.user)
    address = f"/api/v1/projects/{people.project.id}/runs/{run.id}"
    assert people.editor.client.delete(address).status_code in {403, 404}
    assert people.viewer.client.delete(address).status_code == 204
    assert sorted(lasts()) == [("editor", "a1"), ("owner", "a1")]
    delete_account(people.editor.user)
    assert lasts() == [("owner", "a1")]
    Project.objects.all().delete()
    assert not RunPart.objects.exists()


def test_last_runs_stay_with_a_project_that_is_transferred(people, folder):  # noqa: F811
    swept(people, folder, "owner", "editor")
    transfer.transfer_project(people.project.id, "editor", acting_user=people.owner.user)
    assert sorted(lasts()) == [("editor", "a1"), ("owner", "a1")]
    seen = people.editor.client.get(f"/api/v1/projects/{people.project.id}/runs").json()["items"]
    assert [run["is_last"] for run in seen] == [True, True]
    delete_account(people.owner.user)
    assert lasts() == [("editor", "a1")]
