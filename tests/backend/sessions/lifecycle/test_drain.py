"""Before an upgrade."""

from __future__ import annotations

from typing import Any

from django.conf import settings

from backend.accounts.models import AuditEntry
from backend.sessions.lifecycle import drain
from backend.sessions.lifecycle import writes as session_writes
from tests.backend.accounts.test_sharing import project_of


def test_before_an_upgrade_no_robot_starts_and_users_learn_why(person, monkeypatch):
    monkeypatch.setattr(session_writes, "workers", type("Idle", (), {"submit": lambda *_: None}))
    ada, olga = person("ada", is_admin=True), person("olga")
    running, waiting = project_of(olga), project_of(olga, "Later")
    olga.post(f"projects/{running}/session")
    page = "/admin/executor_sessions/session/"
    assert b"Let no robot start" in ada.page(page).content
    token = ada.client.cookies[settings.CSRF_COOKIE_NAME].value
    ada.client.post(
        "/admin/executor_sessions/session/drain/",
        {"message": "Back at 15:00.", "csrfmiddlewaretoken": token},
    )
    assert b"Back at 15:00." in ada.page("/admin/executor_sessions/session/").content
    refused = olga.post(f"projects/{waiting}/session", expect=503)
    assert (refused["code"], refused["hint"]) == ("draining", "Back at 15:00.")
    olga.post(f"projects/{running}/session")  # it continues
    assert session_writes.start_queued() == 0
    assert drain.text().endswith("those that run continue. Back at 15:00.")
    told: list[Any] = []
    assert drain.wait_for_the_last(0, told.append) == 1
    assert told == ["Robots that run: 1. Users who wait for one: 0."]
    drain.lift(acting_user=ada.user)
    assert drain.text() == ""
    olga.post(f"projects/{waiting}/session")
    log = AuditEntry.objects.filter(action__startswith="server.").order_by("id")
    assert [(row.actor_name, row.action) for row in log] == [
        ("ada", "server.drain"),
        ("ada", "server.drain_off"),
    ]
