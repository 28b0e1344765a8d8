"""Temporary files: their total size is limited, some disk space stays free, and no file remains."""

from __future__ import annotations

import asyncio
import errno
import io
import os
import shutil
import subprocess
import sys
import time
import zipfile
from collections import namedtuple
from pathlib import Path
from typing import Any

import pytest
from django.core.files.uploadhandler import MemoryFileUploadHandler

from backend.core import scratch
from backend.core.connection_costs import ABORT
from backend.core.readers import readers
from backend.core.scratch import AlreadyThereError, NoRoomError, Scratch
from backend.ingress import bodies, handler, sending
from backend.ingress.handler import ThreadedHandler
from backend.projects.models import Project
from backend.workers.aside import Aside
from tests.backend.ingress.test_bodies import IMPORT, MEBIBYTE, archive_of, head, parts, refused
from tests.backend.ingress.test_handler import body

pytestmark = pytest.mark.django_db(transaction=True)
Usage = namedtuple("Usage", "total used free")


def test_files_count_what_they_take_until_they_are_closed(tmp_path):
    room = Scratch(tmp_path / "uploads", most=100, reserve=0)
    first, second = room.file(), room.file()
    assert list((tmp_path / "uploads").iterdir()) == []  # without a name
    assert first.write(b"x" * 60) == 60
    with pytest.raises(NoRoomError):
        second.write(b"x" * 41)
    second.write(b"x" * 40)
    first.seek(0)
    first.write(b"y" * 60)  # overwrites existing bytes
    assert room.used == 100
    with pytest.raises(NoRoomError):
        room.file(expected=1)
    first.close()
    first.close()
    assert room.used == 40
    second.close()
    assert room.used == 0


def test_a_folder_of_a_killed_process_is_deleted_with_the_next_one_and_one_in_use_is_not(tmp_path):
    code = "from pathlib import Path; from backend.core.scratch import Scratch; import sys\n"
    code += "with Scratch(Path(sys.argv[1]), 1, 0).directory() as made: print(made, flush=True); input()"
    command = [sys.executable, "-c", code, str(tmp_path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
        theirs = Path(other.stdout.readline().strip())
        (theirs / "half.mcap").write_bytes(b"half")
        long_ago = time.time() - 2 * scratch.MARKED_WITHIN_S
        os.utime(theirs, (long_ago, long_ago))
        room = Scratch(tmp_path, most=100, reserve=0)
        with room.directory() as ours:
            assert sorted(tmp_path.iterdir()) == sorted([ours, theirs]), "it is in use"
        other.kill()
    os.utime(theirs, None)
    with room.directory() as ours:
        assert sorted(tmp_path.iterdir()) == sorted([ours, theirs]), "it may not be marked yet"
    os.utime(theirs, (long_ago, long_ago))
    with room.directory() as ours:
        assert list(tmp_path.iterdir()) == [ours]
    assert list(tmp_path.iterdir()) == []


def test_of_some_files_one_user_has_one(tmp_path):
    room = Scratch(tmp_path, most=100, reserve=0)
    one = room.file(key="data of 1")
    with pytest.raises(AlreadyThereError):
        room.file(key="data of 1")
    room.file(key="data of 2").close()
    one.close()
    room.file(key="data of 1").close()


def test_the_disk_keeps_a_reserve(tmp_path, monkeypatch):
    room = Scratch(tmp_path, most=1 << 40, reserve=1000)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: Usage(5000, 3000, 2000))
    file = room.file(expected=1000)
    for step in (lambda: file.write(b"x" * 1001), lambda: room.file(expected=1001)):
        with pytest.raises(OSError, match="No space") as caught:
            step()
        assert caught.value.errno == errno.ENOSPC
    assert room.used == 0
    file.close()


def streamed(size, **more):
    return head(content_type="application/octet-stream", content_length=str(size), **more)


def test_what_has_no_room_beside_the_others_is_refused_before_it_is_sent(settings_of):
    settings_of(max_temporary_bytes=6 * MEBIBYTE)
    with scratch.scratch().file() as others:
        others.write(b"x" * 4 * MEBIBYTE)
        assert refused(parts(6), streamed(3 * MEBIBYTE), IMPORT) == (503, "busy", 0)
        assert refused(parts(40), head(transfer_encoding="chunked"))[:2] == (503, "busy")
        # A request that needs no file is answered.
        assert refused([body(b"{}")], head(content_length="2"))[0] == 201
    assert scratch.scratch().used == 0
    # A file that would never fit is refused with another error.
    assert refused(parts(20), streamed(7 * MEBIBYTE), IMPORT) == (413, "request_too_large", 0)


def test_when_to_come_again_is_said(settings_of):
    settings_of(max_temporary_bytes=MEBIBYTE)
    sent = []

    async def receive():
        return {"type": "http.disconnect"}

    async def send(message):
        sent.append(message)

    scope: Any = {"type": "http", "method": "POST", "path": "/api/v1/projects", "query_string": b""}
    asyncio.run(ThreadedHandler()(scope | {"headers": head(content_length="5000000")}, receive, send))
    assert sent[0]["status"] == 503
    assert dict(sent[0]["headers"])[b"Retry-After"] == b"15"


def test_the_reserve_is_kept_from_bodies(settings_of, monkeypatch):
    settings_of(min_free_bytes=1 << 60)
    assert refused(parts(6), streamed(3 * MEBIBYTE), IMPORT) == (507, "disk_full", 0)


def test_files_of_forms_count_too(settings_of, monkeypatch, api):
    # The file of the form, and the contents that are read from it.
    settings_of(max_temporary_bytes=4 * MEBIBYTE)
    monkeypatch.setattr(
        MemoryFileUploadHandler, "handle_raw_input", lambda self, *_, **__: setattr(self, "activated", False)
    )
    files = {"file": io.BytesIO(archive_of(MEBIBYTE))}
    files["file"].name = "Large.zip"
    answer = api.client.post("/api/v1/projects/import", files)
    assert answer.status_code == 201, answer.content[:500]
    files = {"file": io.BytesIO(archive_of(3 * MEBIBYTE))}
    files["file"].name = "Large.zip"
    answer = api.client.post("/api/v1/projects/import", files)
    assert (answer.status_code, answer.json()["code"]) == (503, "busy")
    assert answer["Retry-After"]
    assert scratch.scratch().used == 0


def test_a_file_of_a_form_is_there_until_its_request_is_answered():
    """Its thread is released while the file is unpacked; the data for the key are read after that."""
    data = archive_of(5 * MEBIBYTE)
    start = b'--cut\r\nContent-Disposition: form-data; name="file"; filename="p.zip"\r\n\r\n'
    whole = start + data + b"\r\n--cut--\r\n"
    form = head(
        content_type="multipart/form-data; boundary=cut", content_length=str(len(whole)), idempotency_key="k"
    )
    for _ in range(2):
        assert refused([body(whole)], form, IMPORT)[0] == 201
    assert Project.objects.count() == 1
    assert scratch.scratch().used == 0


async def ask(handling, path="/api/v1/me/data"):
    sent = []

    async def receive():
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(message):
        sent.append(message)

    scope: Any = {"type": "http", "method": "GET", "path": path, "query_string": b"", "headers": head()}
    await handling(scope, receive, send)
    return sent[0], [message["body"] for message in sent[1:]]


def test_all_that_is_kept_is_sent_from_a_file_part_by_part(api, settings_of, monkeypatch):
    monkeypatch.setitem(handler.THREADS, "local", 1)
    for name in ("One", "Two", "Three"):
        api.post("projects", {"name": name}, expect=201)
    handling = ThreadedHandler()
    monkeypatch.setattr(sending, "PART", 1000)
    start, sent = asyncio.run(ask(handling))
    assert start["status"] == 200
    assert max(map(len, sent)) <= 1000
    data = b"".join(sent)
    named = {name.lower(): value for name, value in start["headers"]}
    assert int(named[b"content-length"]) == len(data)
    assert named[b"content-security-policy"] == b"default-src 'none'; sandbox"
    with zipfile.ZipFile(io.BytesIO(data)) as packed:
        assert packed.testzip() is None
        assert len([name for name in packed.namelist() if name.startswith("projects/")]) == 3
    assert scratch.scratch().used == 0


def test_packing_that_fails_leaves_nothing_and_may_be_asked_again(api, monkeypatch):
    from backend.workers.errors import BusyError

    api.post("projects", {"name": "One"}, expect=201)
    asking = Aside.ask
    monkeypatch.setattr(Aside, "ask", lambda *_, **__: (_ for _ in ()).throw(BusyError("busy")))
    api.get("me/data", expect=503)
    assert scratch.scratch().used == 0
    monkeypatch.setattr(Aside, "ask", asking)
    assert zipfile.is_zipfile(io.BytesIO(api.get("me/data")))
    assert Project.objects.count() == 1


def test_a_client_that_takes_nothing_is_given_up(api, monkeypatch):
    monkeypatch.setattr(sending, "PATIENCE_S", 0.05)
    monkeypatch.setattr(sending, "PART", 100)
    ended = []
    api.post("projects", {"name": "One"}, expect=201)

    async def never():
        handling = ThreadedHandler()

        async def receive():
            return {"type": "http.request", "body": b"", "more_body": False}

        async def send(message):
            if message.get("body"):
                await asyncio.Event().wait()

        scope: Any = {
            "type": "http",
            "method": "GET",
            "path": "/api/v1/me/data",
            "query_string": b"",
            "headers": head(),
            ABORT: lambda: ended.append(True),
        }
        await handling(scope, receive, send)

    asyncio.run(never())
    assert ended == [True]
    assert scratch.scratch().used == 0
    assert readers().total == 0
    assert bodies.SLOWEST == 8 * 1024
