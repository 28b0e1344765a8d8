"""Rows as the API shows them."""

from __future__ import annotations

from backend.projects.api import presentation
from backend.projects.documents import checking
from backend.projects.models import ChangeSet
from backend.projects.storage import queries
from backend.projects.storage.access import Need


def test_a_project_its_files_and_its_revisions(project, user):
    row = queries.project(project["id"], user=user, need=Need.READ)
    assert presentation.summary(row, None, [])["name"] == "Robot"
    stored = queries.current_file(row, "project.json")
    [shown] = [one for one in presentation.opened(row).rows["files"] if one["path"] == "project.json"]
    assert (shown["content"], shown["left_out"]) == (stored.data.decode(), False)
    assert presentation.revision(ChangeSet.objects.get())["number"] == 1


def large(path, size):
    return {"path": path, "base_revision": 0, "content": "#" * size}


def opened(project, user):
    row = queries.project(project["id"], user=user, need=Need.READ)
    row.refresh_from_db()
    return presentation.opened(row)


def left_out(found):
    return [one["path"] for one in found.rows["files"] if one["left_out"]]


def test_large_files_are_left_out_but_trees_and_settings_are_not(api, project, user, monkeypatch):
    monkeypatch.setattr(presentation, "LARGEST_SENT", 1000)
    files = [large(path, 1001) for path in ("actions/A.py", "assets/a.txt", "trees/T.json", "enums.json")]
    api.save(project["id"], *files, large("assets/b.txt", 1000))
    found = opened(project, user)
    assert left_out(found) == ["actions/A.py", "assets/a.txt"]
    contents = {one["path"]: one["content"] for one in found.rows["files"]}
    assert contents["actions/A.py"] is None
    assert contents["assets/b.txt"] == "#" * 1000
    checked = found.checked_files()
    assert (len(checked["actions/A.py"]), checked["assets/a.txt"]) == (1001, b"")


def test_many_small_files_are_sent_up_to_a_sum(api, project, user, monkeypatch):
    monkeypatch.setattr(presentation, "SENT_BYTES", 2500)
    api.save(project["id"], *[large(f"assets/{n}.txt", 1000) for n in range(4)])
    assert left_out(opened(project, user)) == ["assets/2.txt", "assets/3.txt"]


def test_python_that_is_too_large_is_not_checked_and_the_project_opens(api, project, monkeypatch):
    monkeypatch.setattr(presentation, "LARGEST_SENT", 1000)
    monkeypatch.setattr(checking, "MOST_CHECKED", 5000)
    assert api.save(project["id"], large("actions/A.py", 1400))["checked"]
    assert api.get(f"projects/{project['id']}")["checked"]
    assert not api.save(project["id"], large("actions/B.py", 5000))["checked"]
    assert not api.get(f"projects/{project['id']}")["checked"]
    api.post(f"projects/{project['id']}/check", {"files": []}, expect=413)
