"""Recordings over HTTP."""

from __future__ import annotations

import io
from http import HTTPStatus

import pytest
from mcap.reader import make_reader
from websockets.datastructures import Headers
from websockets.http11 import Request

from executor.manager import recordings
from executor.manager.recordings import Recordings, is_recording
from tests.executor.recorder.test_shelf import filled


def asked(path, range_=None):
    return path, Request(path, Headers({} if range_ is None else {"Range": range_}))


async def test_a_run_comes_in_parts(tmp_path, monkeypatch):
    monkeypatch.setattr(recordings, "MOST_ANSWER_BYTES", 1000)
    folder = tmp_path / "recordings"
    folder.mkdir()
    filled(folder, 45)
    held = Recordings(folder)
    body, tags, total = b"", set(), 1
    while len(body) < total:
        answer = await held.respond(*asked("/recordings/a1/0", f"bytes={len(body)}-"))
        assert answer.status_code == HTTPStatus.PARTIAL_CONTENT
        tags.add(answer.headers["ETag"])
        total = int(answer.headers["Content-Range"].partition("/")[2])
        body += answer.body
    assert len(tags) == 1
    assert sum(1 for _ in make_reader(io.BytesIO(body)).iter_messages()) == 45
    one = await held.respond(*asked("/recordings/a1/0", "bytes=10-19"))
    assert one.body == body[10:20]


@pytest.mark.parametrize(
    ("path", "range_", "status"),
    [
        ("/recordings/ff/0", None, HTTPStatus.NOT_FOUND),
        ("/recordings/ff/0", "bytes=5-", HTTPStatus.NOT_FOUND),
        ("/recordings/../../etc/0", None, HTTPStatus.NOT_FOUND),
        ("/recordings/a1/1", None, HTTPStatus.NOT_FOUND),
        ("/recordings/a1/0", "bytes=1-2,5-6", HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE),
        ("/recordings/a1/0", "bytes=99999999-", HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE),
    ],
)
async def test_what_cannot_be_given_is_said(tmp_path, path, range_, status):
    folder = tmp_path / "recordings"
    folder.mkdir()
    filled(folder, 15)
    held = Recordings(folder)
    if status == HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE:
        await held.respond(*asked("/recordings/a1/0"))
    answer = await held.respond(*asked(path, range_))
    assert answer.status_code == status
    assert answer.body.endswith(b".\n")
    assert is_recording(path)


async def test_a_damaged_recording_is_a_conflict(tmp_path):
    (tmp_path / "recordings" / "a1").mkdir(parents=True)
    (tmp_path / "recordings" / "a1" / "00000.0.mcap").write_bytes(b"nothing")
    answer = await Recordings(tmp_path / "recordings").respond(*asked("/recordings/a1/0"))
    assert answer.status_code == HTTPStatus.CONFLICT


async def test_the_last_run_is_given_by_that_name(tmp_path):
    folder = tmp_path / "recordings"
    folder.mkdir()
    held = Recordings(folder)
    assert (await held.respond(*asked("/recordings/last/0"))).status_code == HTTPStatus.NOT_FOUND
    filled(folder, 45)
    last, named = [(await held.respond(*asked(f"/recordings/{run}/0"))).body for run in ("last", "a1")]
    assert last == named
