"""The statements of a save: few files in one, many in several, the same is stored."""

from __future__ import annotations

import pytest
from django.db import connection
from django.test.utils import CaptureQueriesContext

from backend.projects.models import Draft, FileRevision, Project
from backend.projects.storage import at_once, cache, queries, rows


def new(path, content="x"):
    return {"path": path, "base_revision": 0, "content": content}


@pytest.mark.parametrize("number", [1, at_once.FILES, at_once.FILES + 1, rows.ROWS + 1])
def test_any_number_of_files_is_one_change(api, project, number):
    files = {f"notes/{n:03}.txt": f"note {n % 7}" for n in range(number)}
    done = api.save(project["id"], *(new(path, text) for path, text in files.items()), message="Notes")
    assert done["revision"] == 2
    found = api.get(f"projects/{project['id']}")
    assert {f["path"]: f["content"] for f in found["files"] if f["path"].startswith("notes/")} == files
    assert found["size"] == sum(f["size"] for f in found["files"])
    (newest, *_) = api.get(f"projects/{project['id']}/revisions")["items"]
    assert (newest["number"], newest["message"], len(newest["files"])) == (2, "Notes", number)


@pytest.mark.parametrize("number", [1, at_once.FILES + 1])
def test_writing_and_moving_and_removing_go_together(api, project, number):
    paths = [f"old/{n}.txt" for n in range(number)]
    api.save(project["id"], *(new(path, path) for path in paths), new("gone.txt"))
    moves = [{"path": p, "base_revision": 2, "rename_to": p.replace("old", "new")} for p in paths]
    api.save(project["id"], *moves, {"path": "gone.txt", "base_revision": 2, "delete": True}, new("more.txt"))
    current = queries.current_files(Project.objects.get())
    assert {path: file.text for path, file in current.items() if path.endswith(".txt")} == {
        "more.txt": "x"
    } | {path.replace("old", "new"): path for path in paths}
    moved = FileRevision.objects.filter(change__number=3).exclude(renamed_from="")
    assert set(moved.values_list("renamed_from", flat=True)) == set(paths)


@pytest.mark.parametrize("number", [1, at_once.FILES + 1])
def test_drafts_of_what_is_saved_are_done_with_and_no_others(api, project, number):
    paths = [f"{n}.txt" for n in range(number)]
    for path in (*paths, "other.txt"):
        api.put(f"projects/{project['id']}/drafts/{path}", {"base_revision": 0, "content": "typed"})
    api.save(project["id"], *(new(path) for path in paths))
    assert list(Draft.objects.values_list("path", flat=True)) == ["other.txt"]


def test_what_both_databases_read_is_what_the_orm_reads(api, project):
    api.post(f"projects/{project['id']}/archive")
    expected = Project.objects.get()
    for lock in (False, True):
        found = rows.project(expected.pk, lock=lock)
        for field in Project._meta.concrete_fields:
            assert getattr(found, field.attname) == getattr(expected, field.attname)


def test_a_save_of_a_known_project_asks_for_nothing_but_the_project(api, project):
    api.save(project["id"], new("a.txt", "x"))
    with CaptureQueriesContext(connection) as captured:
        api.save(project["id"], {"path": "a.txt", "base_revision": 2, "content": "y"})
    statements = [
        row["sql"] for row in captured if not row["sql"].startswith(("SAVEPOINT", "RELEASE", "BEGIN"))
    ]
    assert [sql.partition(" ")[0] for sql in statements].count("SELECT") == 1
    if connection.vendor == "postgresql":
        assert [sql.partition(" ")[0] for sql in statements] == ["SELECT", "WITH"]


def test_files_are_remembered_for_the_very_revision_alone(api, project):
    api.save(project["id"], new("a.txt"))
    now = Project.objects.get()
    assert set(cache.files(now)) == {f["path"] for f in project["files"]} | {"a.txt"}
    now.revision += 1
    assert cache.files(now) is None
    now.revision -= 1
    now.updated_at = now.created_at
    assert cache.files(now) is None
