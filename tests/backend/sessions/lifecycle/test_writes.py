"""Sessions over HTTP: one for each project, started once, and ended completely."""

from __future__ import annotations

import importlib
import os
import signal
from uuid import UUID

import psutil
import pytest
from django.apps import apps
from django.utils import timezone

from backend.projects.models import Project
from backend.sessions.choices import SessionKind, SessionState
from backend.sessions.launchers.base import OWN_NETWORK_DOMAIN
from backend.sessions.lifecycle import ros_domains, writes
from backend.sessions.models import Session
from tests.backend.sessions.conftest import children

pytestmark = pytest.mark.django_db(transaction=True)


def launched(session_id):
    """Waits for the launch to end, as `end_session` does."""
    if launch := writes._launches.get(UUID(session_id)):
        launch.result()


def test_a_session_starts_is_found_again_and_ends(api, project, fake_manager):
    fake_manager("echo")
    started = api.post(f"projects/{project['id']}/session")
    assert started["state"] in {"starting", "ready"}
    assert started["control_url"] == f"/ws/sessions/{started['id']}/control"
    assert api.post(f"projects/{project['id']}/session")["id"] == started["id"]
    launched(started["id"])
    assert api.get(f"sessions/{started['id']}")["state"] == "ready"
    pid = Session.objects.get().launcher_state["pid"]
    api.delete(f"sessions/{started['id']}")
    assert not psutil.pid_exists(pid)
    assert api.get(f"sessions/{started['id']}")["state"] == "ended"
    api.delete(f"sessions/{started['id']}")


def test_a_session_can_be_ended_while_it_starts(api, project, fake_manager):
    fake_manager("slow")
    started = api.post(f"projects/{project['id']}/session")
    api.delete(f"sessions/{started['id']}")
    assert api.get(f"sessions/{started['id']}")["state"] == "ended"
    assert children() == []


def test_a_session_can_be_ended_by_who_saw_it_start(api, project, fake_manager):
    fake_manager("echo")
    started = api.post(f"projects/{project['id']}/session")
    launched(started["id"])
    seen = Session.objects.get()
    seen.state, seen.launcher_state = SessionState.STARTING, {}
    writes.end_session(seen)
    assert Session.objects.get().state == "ended"
    assert children() == []


def test_a_session_that_another_server_ended_while_it_started_stays_ended(api, project, fake_manager):
    fake_manager("slow")
    started = api.post(f"projects/{project['id']}/session")
    Session.objects.update(state=SessionState.ENDED)
    launched(started["id"])
    assert Session.objects.get().state == "ended"
    assert children() == []


def test_a_failed_start_says_why_and_another_may_follow(api, project, fake_manager):
    fake_manager("failing")
    started = api.post(f"projects/{project['id']}/session")
    launched(started["id"])
    failed = api.get(f"sessions/{started['id']}")
    assert failed["state"] == "failed"
    assert "exit status 3" in failed["error"]
    assert "the fake manager starts" in failed["error"]
    fake_manager("echo")
    again = api.post(f"projects/{project['id']}/session")
    assert again["id"] != started["id"]
    api.delete(f"sessions/{again['id']}")


def test_an_executor_that_dies_fails_its_session(api, project, fake_manager):
    fake_manager("echo")
    started = api.post(f"projects/{project['id']}/session")
    launched(started["id"])
    pid = Session.objects.get().launcher_state["pid"]
    os.kill(pid, signal.SIGKILL)
    os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT)
    assert api.get(f"sessions/{started['id']}")["state"] == "failed"
    again = api.post(f"projects/{project['id']}/session")
    assert again["id"] != started["id"]
    api.delete(f"sessions/{again['id']}")


def test_an_executor_that_was_ended_did_not_die_by_itself(api, project, fake_manager):
    fake_manager("echo")
    started = api.post(f"projects/{project['id']}/session")
    launched(started["id"])
    seen = Session.objects.get()
    api.delete(f"sessions/{started['id']}")
    assert writes.refresh(seen).state == "ended"
    assert Session.objects.get().error == ""


def test_deleting_a_project_ends_its_session(api, project, fake_manager):
    fake_manager("echo")
    started = api.post(f"projects/{project['id']}/session")
    launched(started["id"])
    api.delete(f"projects/{project['id']}")
    assert Session.objects.get().state == "ended"
    assert children() == []


def test_each_session_has_a_ros_domain_of_its_own(api, fake_manager):
    fake_manager("echo")
    for name in ("One", "Two"):
        pid = api.post("projects", {"name": name}, expect=201)["id"]
        api.post(f"projects/{pid}/session")
    domains = set(Session.objects.values_list("ros_domain_id", flat=True))
    assert len(domains) == 2
    assert domains <= set(ros_domains.ROS_DOMAINS)
    writes.end_all_sessions()
    assert set(Session.objects.values_list("state", flat=True)) == {"ended"}
    assert children() == []


def test_executors_with_networks_of_their_own_share_a_domain_and_are_not_counted_by_domains(
    api, fake_manager, monkeypatch
):
    launcher = fake_manager("echo")
    monkeypatch.setattr(type(launcher), "shares_network", False)
    monkeypatch.setattr(ros_domains, "ROS_DOMAINS", range(5, 6))
    given = []
    start = launcher.start
    monkeypatch.setattr(launcher, "start", lambda spec: given.append(spec.ros_domain_id) or start(spec))
    for name in ("One", "Two"):
        pid = api.post("projects", {"name": name}, expect=201)["id"]
        launched(api.post(f"projects/{pid}/session")["id"])
    assert list(Session.objects.values_list("ros_domain_id", flat=True)) == [None, None]
    assert given == [OWN_NETWORK_DOMAIN] * 2
    assert writes.places_left() > 1000
    writes.end_all_sessions()


def test_a_migration_frees_the_domains_of_containers_alone(project, user):
    states = {"docker": "ready", "process": "starting", "kubernetes": "ended"}
    for number, (launcher, state) in enumerate(states.items(), 5):
        Session.objects.create(
            project=Project.objects.get(), user=user, launcher=launcher, state=state,
            kind=("interactive", "evaluation")[number % 2], ros_domain_id=number, created_at=timezone.now(),
        )  # fmt: skip
    migration = importlib.import_module("backend.sessions.migrations.0007_domains_of_networks")
    migration.give_back_domains(apps, None)
    found = dict(Session.objects.values_list("launcher", "ros_domain_id"))
    assert found == {"docker": None, "process": 6, "kubernetes": 7}


def test_a_full_host_says_so(api, project, fake_manager, monkeypatch):
    fake_manager("echo")
    monkeypatch.setattr(ros_domains, "ROS_DOMAINS", range(5, 6))
    api.post(f"projects/{project['id']}/session")
    other = api.post("projects", {"name": "Other"}, expect=201)
    assert api.post(f"projects/{other['id']}/session", expect=503)["code"] == "host_full"
    writes.end_all_sessions()


def test_the_token_between_relay_and_manager_is_stored_nowhere(api, project, fake_manager):
    fake_manager("echo")
    started = api.post(f"projects/{project['id']}/session")
    launched(started["id"])
    session = Session.objects.get()
    stored = " ".join(str(value) for value in session.__dict__.values())
    assert writes.manager_token(session) not in stored
    api.delete(f"sessions/{started['id']}")


def test_a_project_that_is_not_there_has_no_session(api):
    api.post("projects/00000000-0000-0000-0000-000000000000/session", expect=404)


def test_one_session_follows_each_program_and_bad_addresses_start_none(api, fake_manager):
    fake_manager("echo")
    first = api.post("sessions/attached", {"address": "robot.local"})
    assert first["state"] in {"starting", "ready"}
    assert api.post("sessions/attached", {"address": "robot.local:1667"})["id"] == first["id"]
    other = api.post("sessions/attached", {"address": "robot.local:1700"})
    assert other["id"] != first["id"]
    for address in ("ipc:///tmp/x", "inproc://x", "*:1667", "[::]", "eth0;robot:1667", "robot:99999"):
        refused = api.post("sessions/attached", {"address": address}, expect=400)
        assert refused["code"] == "bad_address"
    for session, address in ((first, "robot.local:1667"), (other, "robot.local:1700")):
        launched(session["id"])
        made = Session.objects.get(pk=session["id"])
        assert (made.kind, made.project) == (SessionKind.ATTACHED, None)
        assert made.target == address
        api.delete(f"sessions/{session['id']}")
    assert Session.objects.count() == 2
