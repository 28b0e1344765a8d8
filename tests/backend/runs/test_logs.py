"""Logs of robots that are kept as runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from backend.runs import logs
from backend.runs.errors import LogRefusedError
from backend.runs.models import Run
from tests.executor.recorder.outside.logs import SAMPLES, btlog, read

LOG = (SAMPLES / "patrol.btlog").read_bytes()

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture
def converter(monkeypatch: pytest.MonkeyPatch) -> None:
    """Makes this server read logs beside itself, as one without accounts does."""
    monkeypatch.setattr(logs, "require_converter", lambda: None)


@pytest.fixture
def own_folder(settings_of, tmp_path: Path) -> Path:
    """A folder of data that no other test uses at the same time."""
    settings_of(data_dir=tmp_path)
    return tmp_path


def send(by, project, data=LOG, name="patrol.btlog"):
    address = f"/api/v1/projects/{project.id}/runs/logs?filename={name}"
    return by.client.post(address, data=data, content_type="application/octet-stream")


@pytest.mark.usefixtures("converter")
def test_a_log_becomes_a_run_of_who_sent_it(people):
    answer = send(people.viewer, people.project)
    assert answer.status_code == 201, answer.json()
    run = answer.json()
    assert (run["name"], run["keeper"], run["start_s"]) == ("patrol.btlog", "viewer", 0.0)
    assert run["length_s"] > 0.1
    address = f"/api/v1/projects/{people.project.id}/runs/{run['id']}/recording"
    said = read(b"".join(people.viewer.client.get(address)))
    assert said[0].fields["name"][0] == "patrol"


@pytest.mark.usefixtures("converter")
@pytest.mark.parametrize(
    ("data", "reason", "text"),
    [
        (b"hello", "not_a_log", "my%20log:0: it is no log of a known kind"),
        (b"", "not_a_log", "no log of a known kind"),
        (btlog([(0, 77, 1)]), "damaged", "node 77 is not in the tree"),
    ],
)
def test_what_is_no_log_is_refused_with_its_place(people, own_folder, data, reason, text):
    answer = send(people.owner, people.project, data, "my%2520log")
    problem = answer.json()
    assert (answer.status_code, problem["code"], problem["reason"]) == (422, "log_refused", reason)
    assert text in problem["detail"]
    assert problem["hint"]
    assert Run.objects.count() == 0
    assert list((own_folder / "uploads").iterdir()) == []


@pytest.mark.usefixtures("converter")
def test_a_log_counts_to_the_quota(people, monkeypatch):
    monkeypatch.setattr("backend.runs.queries.room", lambda _: 100)
    answer = send(people.owner, people.project)
    assert (answer.status_code, answer.json()["code"]) == (413, "quota_exceeded")


def test_a_server_of_a_team_says_that_it_reads_no_logs(people):
    answer = send(people.owner, people.project)
    assert (answer.status_code, answer.json()["code"]) == (503, "logs_unavailable")
    assert "bt-studio convert" in answer.json()["hint"]


@pytest.mark.usefixtures("converter")
def test_what_a_child_wrote_is_not_trusted(people, monkeypatch):
    def convert(log, name, folder):
        (folder / "run.mcap").write_bytes(b"no recording" * 100)
        return folder / "run.mcap"

    monkeypatch.setattr(logs, "convert", convert)
    answer = send(people.owner, people.project)
    assert (answer.status_code, answer.json()["code"]) == (422, "log_refused")
    assert LogRefusedError.code == "log_refused"
