"""Reads of projects."""

from __future__ import annotations

import pytest

from backend.core.problems import NotFoundError
from backend.projects.storage import queries
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
