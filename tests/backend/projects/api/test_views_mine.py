"""The disk use and the data of a user."""

from __future__ import annotations

from backend.projects.api import views_mine


def test_the_room_is_that_of_the_projects(api, project):
    found = api.get("me/usage")
    assert set(found) == set(views_mine.UsageSerializer().fields)
    assert found["projects"] == 1
