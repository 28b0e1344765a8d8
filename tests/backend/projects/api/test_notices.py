"""A new revision is announced to all pages that have the project open."""

from __future__ import annotations

import pytest

from backend.projects.api import notices


def test_a_save_is_announced_when_it_is_committed(
    api, project, monkeypatch, django_capture_on_commit_callbacks
):
    notices.watch_revisions()
    told = []
    monkeypatch.setattr(notices, "tell", lambda group, notice: told.append((group, notice["revision"])))
    with django_capture_on_commit_callbacks(execute=True):
        api.save(project["id"], {"path": "a.txt", "base_revision": 0, "content": "x"})
    assert told == [(notices.group_of(project["id"]), 2)]


@pytest.mark.parametrize("one", ["a", "b"])
def test_each_project_has_a_group_of_its_own(one):
    assert notices.group_of(one) == f"project.{one}"
