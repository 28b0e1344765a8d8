"""A log of a robot becomes a run of a new project."""

from __future__ import annotations

import pytest

from backend.projects.models import Project
from backend.projects.storage import queries
from backend.runs import views_mine
from backend.runs.models import Run
from backend.workers.errors import TookTooLongError
from tests.executor.recorder.outside.logs import NAV, SAMPLES, bag, nav_message

LOG = (SAMPLES / "patrol.btlog").read_bytes()


@pytest.fixture
def converter(monkeypatch: pytest.MonkeyPatch) -> None:
    """Makes this server read logs beside itself, as one without accounts does."""
    monkeypatch.setattr(views_mine, "require_converter", lambda: None)


def send(by, data=LOG, name="patrol.btlog"):
    address = f"/api/v1/runs/logs?filename={name}"
    return by.client.post(address, data=data, content_type="application/octet-stream")


@pytest.mark.usefixtures("converter")
def test_the_project_has_the_tree_of_the_log(people):
    answer = send(people.other)
    assert answer.status_code == 201, answer.json()
    run = answer.json()
    assert (run["project_name"], run["name"], run["may_open"]) == ("patrol", "patrol.btlog", True)
    assert (run["result"], run["has_thumbnail"]) == ("success", True)
    files = queries.contents(Project.objects.get(id=run["project"]))
    assert b"way is free" in files["trees/Main.json"]
    assert "actions/Act.py" in files
    assert send(people.other).json()["project_name"] == "patrol 2"


@pytest.mark.usefixtures("converter")
def test_a_log_without_a_document_gets_an_empty_project(people):
    log = bag([("/behavior_tree_log", NAV, 10**9, nav_message([("go", 1, 0, 1)]))])
    run = send(people.other, log, "a%2Fb.mcap").json()
    assert run["project_name"] == "a-b"
    assert set(queries.contents(Project.objects.get(id=run["project"]))) == {"project.json"}


@pytest.mark.usefixtures("converter")
def test_a_tree_that_takes_too_long_is_left_out(people, monkeypatch):
    class Slow:
        def ask(self, *_, **__):
            from concurrent.futures import Future

            done: Future = Future()
            done.set_exception(TookTooLongError("Slow."))
            return done

    monkeypatch.setattr(views_mine, "pool", Slow)
    assert send(people.other).status_code == 201


@pytest.mark.usefixtures("converter")
def test_nothing_stays_of_a_log_that_is_refused(people, monkeypatch):
    before = Project.objects.count()
    assert send(people.other, b"hello").json()["code"] == "log_refused"
    monkeypatch.setattr("backend.runs.queries.room", lambda _: 100)
    assert send(people.other).json()["code"] == "quota_exceeded"
    assert (Run.objects.count(), Project.objects.count()) == (0, before)


def test_a_server_of_a_team_says_that_it_reads_no_logs(people):
    answer = send(people.other)
    assert (answer.status_code, answer.json()["code"]) == (503, "logs_unavailable")
