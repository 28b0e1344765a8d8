"""Reads of projects."""

from __future__ import annotations

import pytest

from backend.core.problems import NotFoundError
from backend.projects.storage import cache, queries
from backend.projects.storage.access import Need


def test_files_are_those_of_a_revision(api, project, user):
    found = queries.project(project["id"], user=user, need=Need.READ)
    api.save(project["id"], {"path": "a.txt", "base_revision": 0, "content": "two"})
    found.refresh_from_db()
    assert queries.contents(found)["a.txt"] == b"two"
    assert "a.txt" not in queries.files_at(found, 1)
    assert queries.current_file(found, "a.txt").data == b"two"
    with pytest.raises(NotFoundError):
        queries.current_file(found, "b.txt")


def test_what_is_no_text_is_none():
    assert queries.as_text(b"\xff") is None
    assert queries.as_text("ü".encode()) == "ü"
    assert queries.root_diagram(b"nonsense") is None


def test_each_project_has_the_conditions_of_its_own_tree(api):
    made = [api.post("projects", {"template": name}, expect=201) for name in ("laser_bump_and_go", "empty")]
    found = {row["id"]: row["conditions"] for row in api.get("projects")["items"]}
    assert [found[row["id"]] for row in made] == [["CheckObstacle"], []]
    assert made[0]["conditions"] == ["CheckObstacle"]


def test_a_list_reads_trees_and_actions_up_to_a_bound(api, monkeypatch):
    for name in ("First", "Second"):
        one = api.post("projects", {"name": name, "template": "laser_bump_and_go"}, expect=201)["id"]
        note = {"path": "notes.txt", "base_revision": 0, "content": name}
        api.save(one, note)
    read, fetch = [], cache.contents
    monkeypatch.setattr(cache, "contents", lambda hashes: read.append(fetch(list(hashes))) or read[-1])
    items = api.get("projects")["items"]
    assert [row["conditions"] for row in items] == [["CheckObstacle"]] * 2
    monkeypatch.setattr(queries, "LARGEST_SOURCE", 10)
    assert [row["conditions"] for row in api.get("projects")["items"]] == [[], []]
    monkeypatch.setattr(queries, "DRAWN", 10)
    read.clear()
    assert [row["root_diagram"] for row in api.get("projects")["items"]] == [None, None]
    assert not any(read)


def test_a_page_of_a_history_ends_before_it_names_too_many_files(api, project, monkeypatch):
    one = project["id"]
    for number in range(3):
        files = [
            {"path": f"n{number}-{n}.txt", "base_revision": 0, "content": "x"} for n in range(number + 1)
        ]
        api.save(one, *files)
    monkeypatch.setattr(queries, "LISTED_FILES", 4)
    page = api.get(f"projects/{one}/revisions")
    assert ([row["number"] for row in page["items"]], page["next_before"]) == ([4], 4)
    page = api.get(f"projects/{one}/revisions?before=4")
    assert ([row["number"] for row in page["items"]], page["next_before"]) == ([3, 2], 2)
    page = api.get(f"projects/{one}/revisions?before=2")
    assert ([row["number"] for row in page["items"]], page["next_before"]) == ([1], None)


def test_large_files_are_not_compared_line_by_line_and_equal_ones_not_read(api, project, user, monkeypatch):
    one = project["id"]
    for revision in range(2):
        files = [
            {"path": path, "base_revision": 2 * revision, "content": f"{revision}" * size}
            for path, size in (("a.txt", 10), ("b.txt", 1000), ("c.txt", 60))
        ]
        api.save(one, *files, {"path": f"{revision}.txt", "base_revision": 0, "content": "same"})
    row = queries.project(one, user=user, need=Need.READ)
    older, newer = queries.listed_at(row, 2), queries.listed_at(row, 3)
    monkeypatch.setattr(queries, "LARGEST_COMPARED", 100)
    monkeypatch.setattr(queries, "COMPARED", 50)
    found = queries.differing(older, newer)
    assert found == (
        {"a.txt": "0" * 10, "b.txt": None, "c.txt": None},
        {"1.txt": "same", "a.txt": "1" * 10, "b.txt": None, "c.txt": None},
    )
    entries = {entry["path"]: entry["diff"] for entry in api.get(f"projects/{one}/revisions/3/diff")["files"]}
    assert [path for path, diff in entries.items() if diff is None] == ["b.txt", "c.txt"]
