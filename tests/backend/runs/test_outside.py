"""The child that reads a log, as the web server sees it."""

from __future__ import annotations

import io
import subprocess
import sys
from types import SimpleNamespace

import pytest

from backend.runs import outside
from backend.runs.errors import LogRefusedError, LogsUnavailableError
from tests.executor.recorder.outside.logs import SAMPLES, read


def test_the_recording_is_made_in_the_folder(tmp_path):
    log = io.BytesIO((SAMPLES / "patrol.db3").read_bytes())
    made = outside.convert(log, "patrol.db3", tmp_path)
    assert made.parent == tmp_path
    assert len(read(made.read_bytes())) > 50


@pytest.mark.parametrize(
    ("program", "text"),
    [
        ("import os; os.abort()", "more time or memory"),
        ("print('x' * 100_000)", "more time or memory"),
        ("print('{\"code\": 7}')", "more time or memory"),
        ('print(\'{"code": "damaged", "place": 9, "message": "m", "hint": "h"}\')', "f:9: m"),
        ("import time; time.sleep(60)", "took too long"),
    ],
)
def test_a_child_that_fails_is_an_error_of_the_log(program, text, tmp_path, monkeypatch):
    real = subprocess.run

    def run(command, **options):
        return real([sys.executable, "-c", program], **options)

    monkeypatch.setattr(subprocess, "run", run)
    monkeypatch.setattr(outside, "DEADLINE_S", 1.5)
    with pytest.raises(LogRefusedError, match=text) as caught:
        outside.convert(io.BytesIO(b"x"), "f", tmp_path)
    assert caught.value.extra["reason"]


@pytest.mark.parametrize(("mode", "launcher"), [("team", "process"), ("local", "docker")])
def test_where_users_files_are_read_in_containers_none_is_read_beside_the_server(mode, launcher, monkeypatch):
    settings = SimpleNamespace(is_team=mode == "team", has_containers=launcher != "process")
    monkeypatch.setattr(outside, "environment", lambda: settings)
    with pytest.raises(LogsUnavailableError, match="does not read logs"):
        outside.require_converter()
