"""The facts that the server finds out about a recording, from a child and a worker that it does not trust."""

from __future__ import annotations

import json
import subprocess
import sys
from concurrent.futures import Future
from types import SimpleNamespace

import pytest

from backend.runs import facts
from backend.runs.choices import Result
from backend.runs.facts import Facts, facts_of, join_newest
from backend.runs.length import DamagedError
from backend.workers.errors import BusyError
from tests.backend.runs.conftest import SAMPLE


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "run.mcap"
    path.write_bytes(SAMPLE)
    with path.open("rb") as opened:
        yield opened


def child(monkeypatch, program):
    real = subprocess.run
    monkeypatch.setattr(
        subprocess, "run", lambda _, **options: real([sys.executable, "-c", program], **options)
    )


def says(**told):
    return f"print({json.dumps({'messages': 3, 'from_ns': 0, 'to_ns': 10**9} | told)!r})"


def worker(monkeypatch, result):
    def ask(*_, **__):
        if isinstance(result, Exception):
            raise result
        done: Future = Future()
        done.set_result(result)
        return done

    monkeypatch.setattr(facts, "pool", lambda: SimpleNamespace(ask=ask))


def test_times_result_and_picture_are_read_from_the_recording(file):
    found = facts_of(file, "user 1")
    assert (found.start_s, found.length_s, found.result) == (0.0, 1.0, Result.RUNNING)
    assert found.thumbnail_type == "image/jpeg"
    assert found.thumbnail.startswith(b"\xff\xd8\xff")


@pytest.mark.parametrize(
    ("program", "text"),
    [
        (says(code="damaged", message="a record", place=7), r"a record \(byte 7\)"),
        (says(messages=0), "no messages"),
        (says(from_ns=5, to_ns=4), "no messages"),
    ],
)
def test_what_is_no_recording_is_an_error(program, text, file, monkeypatch):
    child(monkeypatch, program)
    with pytest.raises(DamagedError, match=text):
        facts_of(file, "user 1")


@pytest.mark.parametrize(
    "program",
    [
        "import os; os.abort()",
        "print('nonsense')",
        says(to_ns=10**17),
        says(from_ns=-1),
        says(result="won"),
        says(trail=[[1.0]]),
        says(rows=[[1, 2, 3]]),
        says(boxes=[[0.0] * 6] * 1001),
        says(run="../etc"),
        "import time; time.sleep(60)",
    ],
)
def test_of_a_child_that_fails_or_lies_nothing_is_taken_but_the_times_of_the_file(program, file, monkeypatch):
    child(monkeypatch, program)
    monkeypatch.setattr(facts, "DEADLINE_S", 2.0)
    assert facts_of(file, "user 1") == Facts(0.0, 1.0)


@pytest.mark.parametrize(
    "result",
    [
        {"type": "text/html", "data": b"<script>"},
        {"type": "image/jpeg", "data": bytes(1 << 20)},
        {"type": "", "data": b""},
        BusyError("Busy."),
    ],
)
def test_a_run_without_a_picture_is_a_run(result, file, monkeypatch):
    worker(monkeypatch, result)
    found = facts_of(file, "user 1")
    assert (found.thumbnail_type, found.thumbnail, found.length_s) == ("", b"", 1.0)


def test_the_last_run_in_a_folder_is_joined(tmp_path):
    (tmp_path / "runs" / "a1").mkdir(parents=True)
    assert join_newest(tmp_path / "runs", tmp_path / "out", "user 1") is None
    (tmp_path / "runs" / "a1" / "00000.0.mcap").write_bytes(SAMPLE)
    found = join_newest(tmp_path / "runs", tmp_path / "out", "user 1")
    assert (found.run, found.length_s) == ("a1", 1.0)


def test_a_folder_that_takes_too_long_is_an_error(tmp_path, monkeypatch):
    child(monkeypatch, "import os; os.abort()")
    with pytest.raises(DamagedError, match="more time or memory"):
        join_newest(tmp_path, tmp_path / "out", "user 1")
