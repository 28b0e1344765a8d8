"""The one statement for PostgreSQL stores what the ORM stores: the same saves by both, row by row.

On SQLite both are the ORM's; the suite runs on PostgreSQL, too (`tests/backend/test_postgresql.py`).
"""

from __future__ import annotations

import random

import pytest
from django.db import connection, transaction
from django.test.utils import CaptureQueriesContext
from django.utils import timezone

from backend.accounts.models import User
from backend.projects.models import ChangeSet, CurrentFile, Draft, FileRevision, Project
from backend.projects.storage import at_once, rows, writes
from backend.projects.storage.changes import Content, FileChange
from backend.projects.storage.manifest import MANIFEST

STEPS = 12


def rows_of(project):
    """Returns all rows of a project, without keys and times, which always differ."""
    changes = ChangeSet.objects.filter(project=project).order_by("number")
    revisions = FileRevision.objects.filter(change__project=project).exclude(path=MANIFEST)
    files = CurrentFile.objects.filter(project=project).exclude(path=MANIFEST).order_by("path")
    drafts = Draft.objects.filter(project=project).order_by("path")
    return {
        "project": Project.objects.filter(pk=project).values_list("revision", "size", "main_tree").get(),
        "changes": list(changes.values_list("number", "author", "message", "label")),
        "revisions": list(
            revisions.order_by("change__number", "path").values_list(
                "change__number", "path", "blob", "renamed_from"
            )
        ),
        "files": list(files.values_list("path", "path_key", "blob", "blob__size", "revision")),
        "drafts": list(drafts.values_list("path", "content")),
    }


def times_of(project):
    """The times of a project, each as the number of the change set that has it."""
    numbers = {change.created_at: change.number for change in ChangeSet.objects.filter(project=project)}
    files = CurrentFile.objects.filter(project=project).order_by("path")
    own = Project.objects.get(pk=project).updated_at
    return [numbers[own], *(numbers[file.updated_at] for file in files)]


def a_change(chance, files, revision):
    """Returns writes, moves and removals of some files, sometimes more than fit in one statement."""
    wanted, most = [], chance.choice([1, 2, 5, at_once.FILES, at_once.FILES + 3])
    for path in chance.sample(sorted(files), min(len(files), most // 2)):
        kind = chance.choice(["write", "move", "move and write", "remove"])
        to = f"moved/{chance.randrange(10**6)}.txt" if kind.startswith("move") else ""
        text = content(chance) if "write" in kind else None
        wanted.append(FileChange(path, revision, text, delete=kind == "remove", rename_to=to))
    for _ in range(most - len(wanted)):
        wanted.append(FileChange(f"new/{chance.randrange(10**6)}.txt", 0, content(chance)))
    return wanted


def content(chance):
    return Content.of(chance.choice([b"", b"same", b"\0\xff", chance.randbytes(40)]))


@pytest.mark.parametrize("seed", range(4))
def test_the_same_saves_leave_the_same_rows(api, user, monkeypatch, seed):
    chance = random.Random(seed)  # noqa: S311 - it chooses what is saved
    # The names have the same length, so that the sizes are equal.
    ours, theirs = (api.post("projects", {"name": name}, expect=201)["id"] for name in ("Save A", "Save B"))
    for step in range(STEPS):
        now = CurrentFile.objects.filter(project=ours).exclude(path=MANIFEST)
        files = set(now.values_list("path", flat=True))
        revision = Project.objects.get(pk=ours).revision
        for path in (*sorted(files)[:3], "typed.txt"):
            for project in (ours, theirs):
                body = {"base_revision": revision, "content": path}
                api.put(f"projects/{project}/drafts/{path}", body)
        wanted = a_change(chance, files, revision)
        writes.save_files(ours, wanted, acting_user=user, message=f"Step {step}")
        with monkeypatch.context() as patch:
            patch.setattr(rows, "write", rows.store)
            writes.save_files(theirs, wanted, acting_user=user, message=f"Step {step}")
        assert rows_of(ours) == rows_of(theirs)
        assert times_of(ours) == times_of(theirs)


def test_few_files_are_one_statement_on_postgresql_alone(api, project):
    def statements(number):
        files = [{"path": f"{number}/{n}.txt", "base_revision": 0, "content": "x"} for n in range(number)]
        with CaptureQueriesContext(connection) as captured:
            api.save(project["id"], *files)
        return [row["sql"] for row in captured if row["sql"].startswith(("WITH", "INSERT"))]

    few, many = statements(at_once.FILES), statements(at_once.FILES + 1)
    is_postgresql = connection.vendor == "postgresql"
    assert [sql.partition(" ")[0] for sql in few] == (["WITH"] if is_postgresql else ["INSERT"] * 4)
    assert [sql.partition(" ")[0] for sql in many] == ["INSERT"] * 4


def test_the_room_that_other_projects_take_is_what_the_orm_sums(api, user):
    mine, other, gone = (api.post("projects", {"name": name}, expect=201)["id"] for name in ("A", "B", "C"))
    Project.objects.filter(pk=other).update(size=1000)
    Project.objects.filter(pk=gone).update(size=50, deleted_at=timezone.now())
    foreign = api.post("projects", {"name": "D"}, expect=201)["id"]
    Project.objects.filter(pk=foreign).update(owner=User.objects.create(username="someone else"))
    with transaction.atomic():
        project = rows.project(mine, lock=True)
    assert rows.taken_by_others(project) == rows.summed_others(project) == 1000
    assert (at_once.taken_by_others(project) is None) == (connection.vendor != "postgresql")
