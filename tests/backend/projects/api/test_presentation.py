"""Rows as the API shows them."""

from __future__ import annotations

from backend.projects.api import presentation
from backend.projects.models import ChangeSet
from backend.projects.storage import queries
from backend.projects.storage.access import Need


def test_a_project_its_files_and_its_revisions(project, user):
    row = queries.project(project["id"], user=user, need=Need.READ)
    assert presentation.summary(row, None, [])["name"] == "Robot"
    stored = queries.current_file(row, "project.json")
    assert presentation.file(stored)["content"] == stored.data.decode()
    assert presentation.revision(ChangeSet.objects.get())["number"] == 1
