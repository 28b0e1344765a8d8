"""A loss of rights is announced to open sockets."""

from __future__ import annotations

from typing import Any

from django.db import transaction

from backend.accounts.rights import lessen, lessened


def test_it_is_announced_when_it_is_committed(team, django_capture_on_commit_callbacks):
    heard: list[Any] = []

    def hear(sender: Any, *, user_id: Any, project_id: Any, **_: Any) -> None:
        heard.append((user_id, project_id))

    lessened.connect(hear)
    with django_capture_on_commit_callbacks(execute=True), transaction.atomic():
        lessen(user_id=5)
        assert heard == []
    assert heard == [(5, None)]
    lessened.disconnect(hear)
