"""Every route that writes, on a server on which everything fails after the commit.

Database, pool and notices all fail from the commit until the answer is complete. The answer must say that the
write was done, and it must be stored.
"""

from __future__ import annotations

import io
import json
import zipfile
from contextlib import contextmanager
from typing import Any

import pytest
from django.core.files.uploadedfile import SimpleUploadedFile
from django.db import OperationalError, connection
from django.db.backends.base.base import BaseDatabaseWrapper
from django.utils import timezone

from backend.accounts.models import Group, GroupMember, User
from backend.core import notify
from backend.evaluations.models import Evaluation
from backend.projects.models import ChangeSet, Draft, Membership, Project, ShareLink
from backend.workers.priorities import Pools
from tests.backend.accounts.conftest import person, stranger, team  # noqa: F401 - fixtures

pytestmark = pytest.mark.django_db(transaction=True)
SAFE = {"GET", "HEAD", "OPTIONS", "TRACE"}


@contextmanager
def dead_after_commit(monkeypatch):
    """From the first commit on, everything fails that the answer could still need."""
    dead = [False]
    commit: Any = BaseDatabaseWrapper._commit  # type: ignore[attr-defined]

    def committing(wrapper):
        commit(wrapper)
        dead[0] = True

    def asking(execute, sql, params, many, context):
        if dead[0]:
            raise OperationalError("the database went away after the commit")
        return execute(sql, params, many, context)

    def failing(*_, **__):
        raise ConnectionError("nobody answers")

    with monkeypatch.context() as patched, connection.execute_wrapper(asking):
        patched.setattr(BaseDatabaseWrapper, "_commit", committing)
        patched.setattr(Pools, "ask", failing)
        patched.setattr(notify._teller, "tell", failing)
        patched.setattr("backend.projects.api.notices.tell", failing)
        patched.setattr("backend.accounts.rights.tell", failing)
        yield dead


def zip_of():
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as packed:
        packed.writestr("project.json", '{"format": "bt-studio/project", "version": 1, "name": "Brought"}')
    return stream.getvalue()


def change(path="actions/Go.py", base=0, **more):
    return {"message": "m", "files": [{"path": path, "base_revision": base, "content": "x = 1\n"} | more]}


# The requests, each with a check that its effect is stored; `one` is a project at revision 2.
WRITES = {
    "create_project": lambda one: ("POST", "projects", {"name": "Other"}),
    "edit_project": lambda one: ("PATCH", f"projects/{one}", {"base_revision": 2, "name": "New"}),
    "delete_project": lambda one: ("DELETE", f"projects/{one}", None),
    "archive_project": lambda one: ("POST", f"projects/{one}/archive", {}),
    "duplicate_project": lambda one: ("POST", f"projects/{one}/duplicate", {"name": "Copy"}),
    "save_changes": lambda one: ("POST", f"projects/{one}/changes", change()),
    "label_revision": lambda one: ("PATCH", f"projects/{one}/revisions/1", {"label": "first"}),
    "restore_revision": lambda one: ("POST", f"projects/{one}/revisions/1/restore", {}),
    "save_draft": lambda one: (
        "PUT",
        f"projects/{one}/drafts/actions/Go.py",
        {"base_revision": 0, "content": "draft"},
    ),
    "discard_draft": lambda one: ("DELETE", f"projects/{one}/drafts/actions/Old.py", None),
    "make_share_link": lambda one: ("POST", f"projects/{one}/shares/links", {}),
    "share_with_person": lambda one: (
        "POST",
        f"projects/{one}/shares",
        {"name": "fred", "role": "viewer"},
    ),
    "unshare_with_person": lambda one: ("DELETE", f"projects/{one}/shares/people/eve", None),
    "transfer_project": lambda one: ("POST", f"projects/{one}/transfer", {"name": "eve"}),
    "create_group": lambda one: ("POST", "groups", {"name": "Class"}),
}
DONE = {
    "create_project": lambda one: Project.objects.filter(name="Other").exists(),
    "edit_project": lambda one: Project.objects.get(pk=one).name == "New",
    "delete_project": lambda one: Project.objects.get(pk=one).deleted_at is not None,
    "archive_project": lambda one: Project.objects.get(pk=one).archived_at is not None,
    "duplicate_project": lambda one: Project.objects.filter(name="Copy").exists(),
    "save_changes": lambda one: Project.objects.get(pk=one).revision == 3,
    "label_revision": lambda one: ChangeSet.objects.get(project=one, number=1).label == "first",
    "restore_revision": lambda one: Project.objects.get(pk=one).revision == 3,
    "save_draft": lambda one: Draft.objects.filter(project=one, content="draft").exists(),
    "discard_draft": lambda one: not Draft.objects.filter(project=one, path="actions/Old.py").exists(),
    "make_share_link": lambda one: ShareLink.objects.filter(project=one).exists(),
    "share_with_person": lambda one: Membership.objects.filter(project=one, user__username="fred").exists(),
    "unshare_with_person": lambda one: not Membership.objects.filter(user__username="eve").exists(),
    "transfer_project": lambda one: Project.objects.get(pk=one).owner.username == "eve",
    "create_group": lambda one: Group.objects.filter(name="Class").exists(),
}


@pytest.fixture
def owner(person):  # noqa: F811
    person("eve")
    person("fred")
    return person("olga", is_teacher=True)


@pytest.fixture
def one(owner):
    made = owner.post("projects", {"name": "Robot"}, expect=201)["id"]
    owner.save(made, change("actions/Old.py")["files"][0])
    owner.post(f"projects/{made}/shares", {"name": "eve", "role": "editor"})
    owner.put(f"projects/{made}/drafts/actions/Old.py", {"base_revision": 0, "content": "old"})
    return made


@pytest.mark.parametrize("name", WRITES)
def test_what_was_written_is_said_to_be_written(owner, one, monkeypatch, name):
    method, path, body = WRITES[name](one)
    data = {} if body is None else {"data": json.dumps(body), "content_type": "application/json"}
    with dead_after_commit(monkeypatch) as dead:
        response = owner.client.generic(method, f"/api/v1/{path}", **data)
    assert dead[0], "nothing was committed"
    assert response.status_code < 300, response.content[:1000]
    assert DONE[name](one)


@pytest.mark.parametrize("form", [True, False])
def test_an_import_is_said_to_be_imported(owner, monkeypatch, form):
    with dead_after_commit(monkeypatch) as dead:
        if form:
            file = SimpleUploadedFile("p.zip", zip_of())
            response = owner.client.post("/api/v1/projects/import", {"file": file})
        else:
            response = owner.client.generic(
                "POST",
                "/api/v1/projects/import?filename=p.zip",
                data=zip_of(),
                content_type="application/octet-stream",
            )
    assert dead[0]
    assert response.status_code == 201, response.content[:1000]
    assert Project.objects.filter(name="Brought").exists()


def test_what_is_taken_back_is_said_to_be_taken_back(owner, one, monkeypatch):
    link = owner.post(f"projects/{one}/shares/links", {}, expect=201)["links"][0]["id"]
    group = owner.post("groups", {"name": "Class"}, expect=201)["id"]
    GroupMember.objects.create(
        group_id=group, user=User.objects.get(username="eve"), joined_at=timezone.now()
    )
    owner.put(f"projects/{one}/shares/groups/{group}", {"role": "viewer"})
    calls = [
        ("DELETE", f"projects/{one}/shares/links/{link}"),
        ("DELETE", f"projects/{one}/shares/groups/{group}"),
        ("DELETE", f"groups/{group}/members/eve"),
        ("DELETE", f"groups/{group}"),
    ]
    for method, path in calls:
        with dead_after_commit(monkeypatch) as dead:
            response = owner.client.generic(method, f"/api/v1/{path}")
        assert dead[0], path
        assert response.status_code == 204, (path, response.content[:1000])
    assert owner.get(f"projects/{one}/shares")["links"] == []
    assert not Group.objects.exists()


def test_an_evaluation_that_was_started_or_cancelled_is_said_to_be(owner, one, monkeypatch):
    yaml = "format: bt-studio/evaluation\nversion: 1\nduration_s: 5\nruns: 4\n"
    owner.save(one, {"path": "evaluations/room.yaml", "base_revision": 0, "content": yaml})
    with dead_after_commit(monkeypatch) as dead:
        started = owner.client.post(
            f"/api/v1/projects/{one}/evaluations", {"name": "room", "runs": 3}, "application/json"
        )
    assert dead[0]
    assert started.status_code == 201, started.content[:1000]
    found = Evaluation.objects.get(project=one)
    assert started.json()["id"] == str(found.id)
    with dead_after_commit(monkeypatch) as dead:
        cancelled = owner.client.post(f"/api/v1/projects/{one}/evaluations/{found.id}/cancel")
    assert dead[0]
    assert cancelled.status_code == 200, cancelled.content[:1000]
    found.refresh_from_db()
    assert found.state == cancelled.json()["state"] == "cancelled"


def test_every_route_that_writes_is_here_or_named():
    """A new route fails this test until it is either tested above or listed here."""
    elsewhere = {
        "restore_project",  # as archive_project: one function, one transaction
        "unarchive_project",
        "share_with_group",
        "unshare_with_group",
        "revoke_share_link",
        "rename_group",
        "delete_group",
        "remove_group_member",
        "invite_to_group",
        "revoke_invitation",
        "import_project",  # above
        "import_part",  # by the function of save_files
        "delete_my_account",
        "start_session",  # a repeated request is answered with the existing session; so is the next one
        "attach",
        "end_session",
        "keep_run",  # one transaction, and nothing is read for the answer; so are the next five
        "keep_log",
        "open_log",
        "change_run",
        "delete_run",
        "delete_my_run",
        "start_evaluation",  # below; so is the next one, and the next three are as it
        "cancel_evaluation",
        "resume_evaluation",
        "compare_evaluation",
        "ask_replay",
        "cancel_replay",
        "delete_evaluation",  # one transaction, and nothing is read for the answer
        # These store nothing.
        "prepare_attach",
        "inspect_import",
        "change_distribution",
        "check_project",
        "test_project",
        "test_with_python",
        "end_test_with_python",
        "write_tree_xml",
        "read_tree_xml",
        "inspect_action",
        "format_python",
        "lint_python",
    }
    from backend.config.schema_view import document

    found = {
        operation["operationId"]
        for methods in document()["paths"].values()
        for method, operation in methods.items()
        if method.upper() not in SAFE and isinstance(operation, dict) and "operationId" in operation
    }
    assert found == elsewhere | set(WRITES)
