"""Leftovers of a killed server are ended, and executors that outlive their server continue."""

from __future__ import annotations

from datetime import timedelta

import pytest
from django.utils import timezone

from backend.projects.models import Project
from backend.sessions.choices import SessionState
from backend.sessions.lifecycle.orphans import end_orphans
from backend.sessions.models import Session
from tests.backend.sessions.conftest import spec

pytestmark = pytest.mark.django_db(transaction=True)


def test_what_a_killed_server_left_is_ended_at_the_next_start(api, project, user, fake_manager):
    launcher = fake_manager("echo")
    started = launcher.start(spec())
    Session.objects.create(
        project=Project.objects.get(), user=user, launcher="process", launcher_state=started.state,
        state=SessionState.READY, ros_domain_id=5, created_at=timezone.now(),
    )  # fmt: skip
    fake_manager("echo")
    end_orphans()
    assert Session.objects.get().state == "ended"
    assert launcher.poll(started.state) is not None


def test_an_executor_that_outlived_its_server_and_died_says_why(
    api, project, user, fake_manager, monkeypatch
):
    launcher = fake_manager("echo")
    monkeypatch.setattr(launcher, "survives_server", True, raising=False)
    monkeypatch.setattr(launcher, "running", tuple, raising=False)
    started = launcher.start(spec())
    Session.objects.create(
        project=Project.objects.get(), user=user, launcher="process", launcher_state=started.state,
        state=SessionState.READY, ros_domain_id=5, created_at=timezone.now(),
    )  # fmt: skip
    end_orphans()
    assert Session.objects.get().state == "ready", "what runs continues"
    launcher.stop(started.state, timeout_s=5)
    monkeypatch.setattr(launcher, "poll", lambda _state: 3)
    end_orphans()
    session = Session.objects.get()
    assert (session.state, session.error) == ("failed", "The session ended by itself.")


def test_a_start_that_no_server_can_still_be_at_work_on_is_ended(project, user, fake_manager, monkeypatch):
    launcher = fake_manager("echo")
    monkeypatch.setattr(launcher, "survives_server", True, raising=False)
    monkeypatch.setattr(launcher, "running", tuple, raising=False)
    now = timezone.now()
    queued_long = {"created_at": now - timedelta(hours=2), "used_at": now}  # it got its place just now
    left = {"created_at": now - timedelta(hours=1), "used_at": None}
    rows = [
        Session.objects.create(
            project=Project.objects.get(), user=user, kind=kind, launcher="process",
            state=SessionState.STARTING, **times,
        )
        for kind, times in (("interactive", queued_long), ("evaluation", left))
    ]  # fmt: skip
    end_orphans()
    states = [Session.objects.get(id=row.id).state for row in rows]
    assert states == ["starting", "ended"]
