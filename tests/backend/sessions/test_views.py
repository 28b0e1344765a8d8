"""The addresses of sessions."""

from __future__ import annotations

from uuid import uuid4

from backend.sessions import views


def test_a_session_that_is_not_there_answers_404(api, project):
    assert api.get(f"sessions/{uuid4()}", expect=404)["code"] == "not_found"
    assert api.get(f"projects/{project['id']}/session", expect=405)
    assert views.ProjectSession.__doc__
