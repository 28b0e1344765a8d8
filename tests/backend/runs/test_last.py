"""The last run of each project and user, which is kept by itself."""

from __future__ import annotations

from types import SimpleNamespace
from uuid import uuid4

import pytest
from django.db import OperationalError
from django.utils import timezone

from backend.config.environment import environment
from backend.projects.sharing import memberships
from backend.runs import last, queries
from backend.runs.apps import RunsConfig
from backend.runs.models import Run, RunPart
from backend.sessions.choices import SessionState
from backend.sessions.models import Session
from backend.sessions.signals import session_ends, sessions_maintained
from tests.backend.runs.conftest import SAMPLE, keep
from tests.fakes.recordings import TOKEN, recordings


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The folder in which executors leave their recordings."""
    place = tmp_path / "recordings"
    place.mkdir()
    monkeypatch.setattr(last, "launcher", lambda: SimpleNamespace(recordings=place))
    return place


def session(by, project, state=SessionState.ENDED):
    return Session.objects.create(
        project=project, user=by.user, state=state, launcher="process", created_at=timezone.now()
    )


def leave(folder, of, run="a1", data=SAMPLE):
    """Leaves a recording as the executor of a session does."""
    place = folder / str(of.id) / "runs" / run
    place.mkdir(parents=True)
    (place / "00000.0.mcap").write_bytes(data)


def lasts():
    return [(run.keeper.username, run.recorded_as) for run in Run.objects.filter(is_last=True)]


@pytest.mark.parametrize("state", [SessionState.ENDED, SessionState.FAILED])
def test_the_last_run_of_a_session_that_is_over_is_kept_and_its_folder_removed(people, folder, state):
    leave(folder, session(people.viewer, people.project, state))
    assert last.sweep() == 1
    assert lasts() == [("viewer", "a1")]
    assert list(folder.iterdir()) == []
    (row,) = people.viewer.client.get(f"/api/v1/projects/{people.project.id}/runs").json()["items"]
    assert (row["is_last"], row["name"], row["length_s"], row["has_thumbnail"]) == (True, "", 1.0, True)
    stored = Run.objects.get(id=row["id"])
    assert b"".join(queries.parts(stored, 0, stored.size)) != b""


def test_a_session_that_lives_is_left_alone(people, folder):
    leave(folder, session(people.owner, people.project, SessionState.READY))
    assert last.sweep() == 0
    assert len(list(folder.iterdir())) == 1


def test_the_next_last_run_replaces_it_for_each_user_and_project(people, folder):
    for by, run in ((people.owner, "a1"), (people.editor, "b2"), (people.owner, "c3")):
        leave(folder, session(by, people.project), run)
        last.sweep()
    assert sorted(lasts()) == [("editor", "b2"), ("owner", "c3")]
    assert set(RunPart.objects.values_list("run", flat=True)) == set(Run.objects.values_list("id", flat=True))


def test_it_is_kept_within_the_quota_alone_and_the_one_before_stays_where_there_is_no_room(
    people, folder, monkeypatch
):
    leave(folder, session(people.owner, people.project), "a1")
    last.sweep()
    size = Run.objects.get().size
    for room, expected in ((size, "b2"), (size - 1, "b2")):
        limits = environment().model_copy(update={"max_user_run_bytes": room})
        monkeypatch.setattr("backend.runs.queries.environment", lambda limits=limits: limits)
        leave(folder, session(people.owner, people.project), "b2" if room == size else "c3")
        last.sweep()
        assert lasts() == [("owner", expected)]


@pytest.mark.usefixtures("manager")
def test_a_run_that_was_kept_is_not_kept_again(people, folder):
    keep(people.owner, people.project)
    leave(folder, session(people.owner, people.project), "a1")
    last.sweep()
    assert lasts() == []


@pytest.mark.parametrize("change", [{"is_last": False}, {"note": "Why?"}, {"is_pinned": True}])
def test_a_last_run_that_is_changed_is_a_kept_one(people, folder, change):
    leave(folder, session(people.owner, people.project), "a1")
    last.sweep()
    run = Run.objects.get()
    address = f"/api/v1/projects/{people.project.id}/runs/{run.id}"
    answer = people.owner.client.patch(address, change, content_type="application/json").json()
    assert answer["is_last"] is False
    assert answer["name"].startswith(f"{run.created_at:%Y-%m-%d}")
    leave(folder, session(people.owner, people.project), "b2")
    last.sweep()
    assert sorted(Run.objects.values_list("recorded_as", "is_last")) == [("a1", False), ("b2", True)]
    wrong = people.owner.client.patch(address, {"is_last": True}, content_type="application/json")
    assert wrong.json()["field"] == "is_last"


def test_last_runs_do_not_push_out_kept_ones(people, folder, monkeypatch):
    monkeypatch.setattr("backend.runs.writes.MOST_UNPINNED", 1)
    leave(folder, session(people.owner, people.project), "a1")
    last.sweep()
    address = f"/api/v1/projects/{people.project.id}/runs/{Run.objects.get().id}"
    people.owner.client.patch(address, {"is_last": False}, content_type="application/json")
    leave(folder, session(people.owner, people.project), "b2")
    last.sweep()
    assert Run.objects.count() == 2


def off(people, monkeypatch):
    limits = environment().model_copy(update={"keep_last_runs": False})
    monkeypatch.setattr(last, "environment", lambda: limits)


def no_right(people, monkeypatch):
    memberships.unshare_with_person(people.project.id, "viewer", acting_user=people.owner.user)


def closed(people, monkeypatch):
    people.viewer.user.is_active = False
    people.viewer.user.save()


def deleted(people, monkeypatch):
    people.project.deleted_at = timezone.now()
    people.project.save()


@pytest.mark.parametrize("why", [off, no_right, closed, deleted])
def test_nothing_is_kept_that_is_not_wanted_or_not_allowed(people, folder, why, monkeypatch):
    leave(folder, session(people.viewer, people.project))
    why(people, monkeypatch)
    assert last.sweep() == 1
    assert (Run.objects.count(), list(folder.iterdir())) == (0, [])


def test_damaged_and_strange_folders_are_removed_and_keep_nothing(people, folder):
    leave(folder, session(people.owner, people.project), data=b"no recording")
    (folder / "not a session").mkdir()
    (folder / str(uuid4())).mkdir()
    assert last.sweep() == 3
    assert (Run.objects.count(), list(folder.iterdir())) == (0, [])


def test_a_folder_stays_while_the_database_is_away(people, folder, monkeypatch):
    leave(folder, session(people.owner, people.project))

    def away(*_):
        raise OperationalError("away")

    with monkeypatch.context() as patch:
        patch.setattr("backend.runs.writes.store_last", away)
        last.sweep()
    assert len(list(folder.iterdir())) == 1
    last.sweep()
    assert lasts() == [("owner", "a1")]


@pytest.mark.django_db(transaction=True)
@pytest.mark.parametrize(("fault", "kept"), [("", 1), ("cut", 0), ("hangs_up", 0)])
def test_of_a_container_the_last_run_is_fetched_before_it_ends(people, monkeypatch, fault, kept):
    monkeypatch.setattr(last, "launcher", lambda: SimpleNamespace(recordings=None))
    monkeypatch.setattr(last, "manager_token", lambda _: TOKEN)
    it = session(people.owner, people.project, SessionState.READY)
    with recordings(SAMPLE, fault=fault, run="last") as address:
        it.address = address
        last.fetch_last(Session, session=it)
    assert len(lasts()) == kept
    assert last.sweep() == 0


def test_the_app_listens_to_the_end_of_sessions():
    assert RunsConfig.name == "backend.runs"
    heard = [
        receiver[0][0] for signal in (session_ends, sessions_maintained) for receiver in signal.receivers
    ]
    assert heard == ["fetch_last", "sweep_soon", "round_of_evaluations"]
