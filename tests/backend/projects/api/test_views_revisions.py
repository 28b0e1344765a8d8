"""Revisions and drafts."""

from __future__ import annotations

from backend.projects.api import views_revisions


def test_a_revision_is_listed_compared_and_restored(api, project):
    one = project["id"]
    api.save(one, {"path": "a.txt", "base_revision": 0, "content": "two"}, message="Add a")
    assert [row["number"] for row in api.get(f"projects/{one}/revisions")["items"]] == [2, 1]
    [changed] = api.get(f"projects/{one}/revisions/2/diff")["files"]
    assert (changed["path"], changed["change"]) == ("a.txt", "added")
    api.post(f"projects/{one}/revisions/1/restore", {})
    assert api.get(f"projects/{one}/files/a.txt", expect=404)
    assert views_revisions.Revisions.__doc__
