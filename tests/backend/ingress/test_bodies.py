"""Bodies: headers are checked before anything is read, bodies are limited, and clients get the answer."""

from __future__ import annotations

import asyncio
import io
import json
import os
import socket
import threading
import zipfile
from typing import Any

import pytest

from backend.core import guard
from backend.core.processes.siblings import siblings
from backend.ingress import bodies, sending
from backend.ingress.bodies import UNKNOWN_BYTES, Upload
from backend.ingress.handler import ThreadedHandler
from backend.projects.models import Project
from backend.projects.storage.usage import room_for_archive
from tests.backend.accounts.conftest import PUBLIC, Person
from tests.backend.conftest import HOST
from tests.backend.ingress.test_handler import ask, body
from tests.backend.serving import serving

MEBIBYTE = 1024 * 1024
IMPORT = "/api/v1/projects/import"
pytestmark = pytest.mark.django_db(transaction=True)


def head(browser=None, **more):
    """Headers of a local client with the token, or of a browser on a server with accounts."""
    given = {
        "host": HOST,
        "authorization": f"Bearer {guard.keys().token}",
        "content-type": "application/json",
    }
    if browser is not None:
        cookies = "; ".join(f"{name}={morsel.value}" for name, morsel in browser.client.cookies.items())
        given |= {"host": PUBLIC, "origin": f"http://{PUBLIC}", "cookie": cookies, "authorization": ""}
    given |= {name.replace("_", "-"): value for name, value in more.items()}
    return [(name.encode(), value.encode()) for name, value in given.items()]


def refused(messages, headers, path="/api/v1/projects", **more):
    """Returns status and code of the answer, and the number of parts of the body that were read before it."""
    waiting, sent, read = list(messages), [], None

    async def receive():
        return waiting.pop(0) if waiting else {"type": "http.disconnect"}

    async def send(message):
        nonlocal read
        read = len(messages) - len(waiting) if read is None else read
        sent.append(message)

    scope: Any = {
        "type": "http",
        "method": "POST",
        "path": path,
        "query_string": b"",
        "headers": headers,
    } | more
    upload = Upload(IMPORT, room_for_archive)
    asyncio.run(ThreadedHandler(upload)(scope, receive, send))
    named = {name.lower(): value for name, value in sent[0]["headers"]}
    assert b"content-security-policy" in named
    document = json.loads(b"".join(message.get("body", b"") for message in sent))
    if sent[0]["status"] < 400:
        return sent[0]["status"], "", read
    assert named[b"content-type"] == b"application/problem+json"
    assert document["status"] == sent[0]["status"]
    return document["status"], document["code"], read


def parts(number, size=MEBIBYTE // 2):
    return [body(b"x" * size, more=True)] * number


def test_who_is_refused_for_their_headers_sends_nothing():
    headers = [*head(content_length="1500000000", authorization="")]
    assert refused(parts(4), headers) == (403, "link_required", 0)
    foreign = head(content_length="9", host="evil.example")
    assert refused([body(b"123456789")], foreign) == (421, "host_refused", 0)


def test_a_length_beyond_the_bound_is_refused_before_anything_is_read():
    assert refused(parts(4), head(content_length=str(64 * MEBIBYTE + 1))) == (413, "request_too_large", 0)


def test_what_comes_is_counted_whatever_the_headers_say(settings_of):
    settings_of(max_request_bytes=2 * MEBIBYTE)
    for more in ({"transfer_encoding": "chunked"}, {"content_length": "10"}):
        status, code, read = refused(parts(12), head(**more))
        assert (status, code) == (413, "request_too_large")
        assert read <= 5


def test_a_stranger_and_a_guest_may_send_little(person):
    stranger = Person()
    assert refused(parts(4), head(stranger, content_length=str(UNKNOWN_BYTES + 1))) == (
        413,
        "request_too_large",
        0,
    )
    status, code, read = refused(parts(9), head(stranger, transfer_encoding="chunked"))
    assert (status, code, read) == (413, "request_too_large", 3)
    small = [body(b"x" * 1000)]
    assert refused(small, head(stranger, content_length="1000"))[:2] == (401, "sign_in_required")
    owner, guest = person("olga"), Person()
    one = owner.post("projects", {"name": "Robot"}, expect=201)["id"]
    link = owner.post(f"projects/{one}/shares/links", {}, expect=201)["links"][0]
    guest.page(link["url"].partition(PUBLIC)[2])
    assert refused(parts(4), head(guest, content_length=str(9 * MEBIBYTE))) == (413, "request_too_large", 0)
    looked = refused([*parts(4), body(b"")], head(guest, content_length=str(2 * MEBIBYTE)))
    assert looked == (403, "account_required", 5)
    read_and_no_json = refused([*parts(4), body(b"")], head(owner, content_length=str(2 * MEBIBYTE)))
    assert read_and_no_json == (400, "parse_error", 5)


def test_a_user_sends_only_a_few_large_bodies_at_a_time(person, monkeypatch):
    monkeypatch.setattr(bodies, "LARGE_AT_ONCE", 1)
    owner = person("olga")
    handling = ThreadedHandler()
    headers = head(owner, content_length=str(2 * MEBIBYTE))
    scope: Any = {
        "type": "http",
        "method": "POST",
        "path": "/api/v1/projects",
        "query_string": b"",
        "headers": headers,
    }

    async def both():
        heard: asyncio.Queue[Any] = asyncio.Queue()
        open_ended = asyncio.create_task(handling(scope | {}, asyncio.Queue().get, heard.put))
        async with asyncio.timeout(60):
            while not siblings._taken:  # noqa: ASYNC110 - until the first is being read
                await asyncio.sleep(0.01)
            rest: asyncio.Queue[Any] = asyncio.Queue()
            rest.put_nowait({"type": "http.disconnect"})
            await handling(scope | {}, rest.get, heard.put)
        open_ended.cancel()
        await asyncio.gather(open_ended, return_exceptions=True)
        return heard.get_nowait()

    answer = asyncio.run(both())
    assert answer["status"] == 429
    assert b"Retry-After" in dict(answer["headers"])
    assert not siblings._taken


def test_a_body_that_comes_too_slowly_is_given_up(monkeypatch):
    monkeypatch.setattr(bodies, "PATIENCE_S", 0.2)
    monkeypatch.setattr(sending, "LINGER_S", 0.1)
    sent = []

    async def receive():
        await asyncio.Event().wait()

    async def send(message):
        sent.append(message)

    headers = head(content_length="100")
    scope: Any = {
        "type": "http",
        "method": "POST",
        "path": "/api/v1/projects",
        "query_string": b"",
        "headers": headers,
    }
    asyncio.run(ThreadedHandler()(scope, receive, send))
    assert sent[0]["status"] == 408


def test_a_disk_without_room_is_reported(settings_of, monkeypatch, tmp_path):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(bodies, "write_all", full)
    assert refused(parts(12), head(transfer_encoding="chunked"))[:2] == (507, "disk_full")


def test_large_bodies_are_written_by_threads_and_leave_nothing(monkeypatch, settings_of, tmp_path):
    settings_of(data_dir=tmp_path)
    writers, write = set(), bodies.write_all

    def noting(*arguments):
        writers.add(threading.current_thread().name)
        return write(*arguments)

    monkeypatch.setattr(bodies, "write_all", noting)
    handling = ThreadedHandler()
    lengths = []

    def answer(request):
        from django.http import HttpResponse

        lengths.append((len(request.body), request.META["CONTENT_LENGTH"]))
        return HttpResponse()

    monkeypatch.setattr(handling, "get_response", answer)
    ask(*parts(20), body(b"end"), handling=handling, method="POST", headers=head(transfer_encoding="chunked"))
    assert lengths == [(10 * MEBIBYTE + 3, str(10 * MEBIBYTE + 3))]
    assert writers
    assert all(name.startswith("bodies") for name in writers)
    assert list((tmp_path / "uploads").iterdir()) == []


def archive_of(*sizes):
    """Returns a project zip that compression does not make smaller."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as packed:
        packed.writestr("project.json", '{"format": "bt-studio/project", "version": 1, "name": "Large"}')
        for number, size in enumerate(sizes):
            packed.writestr(f"assets/{number}.bin", os.urandom(size))
    return stream.getvalue()


def test_an_archive_may_be_as_large_as_its_user_has_room(settings_of):
    settings_of(max_request_bytes=MEBIBYTE, max_user_bytes=8 * MEBIBYTE)
    data = archive_of(3 * MEBIBYTE)
    streamed = {"content_type": "application/octet-stream", "content_length": str(len(data))}
    pieces = [body(data[at : at + MEBIBYTE], more=True) for at in range(0, len(data), MEBIBYTE)]
    done = refused([*pieces, body(b"")], head(**streamed), IMPORT, query_string=b"filename=Large.zip")
    assert done[0] == 201
    assert refused([*pieces, body(b"")], head(content_length=str(len(data))), IMPORT)[:2] == (
        413,
        "request_too_large",
    )
    more = head(content_type="application/octet-stream", content_length=str(6 * MEBIBYTE))
    assert refused(pieces, more, IMPORT) == (413, "request_too_large", 0)


def test_the_quota_is_asked_before_an_archive_is_read(settings_of):
    settings_of(max_user_projects=1)
    data = archive_of(10)
    streamed = {"content_type": "application/octet-stream", "content_length": str(len(data))}
    done = refused([body(data)], head(**streamed), IMPORT, query_string=b"filename=Large.zip")
    assert done[0] == 201
    assert refused([body(data)], head(**streamed), IMPORT) == (413, "quota_exceeded", 0)


def test_an_archive_that_is_sent_again_with_its_key_is_imported_once():
    data = archive_of(10)
    streamed = {"content_type": "application/octet-stream", "content_length": str(len(data))}
    headers = head(**streamed, idempotency_key="once")
    for _ in range(2):
        assert refused([body(data)], headers, IMPORT)[0] == 201
    assert Project.objects.count() == 1
    other = archive_of(11)
    changed = head(**(streamed | {"content_length": str(len(other))}), idempotency_key="once")
    assert refused([body(other)], changed, IMPORT)[1] == "idempotency_key_reused"


def exchange(port, head_text, data=b"", *, chunked=False):
    """Sends a whole request like a simple client, which reads only afterwards; returns the answer."""
    with socket.create_connection(("127.0.0.1", port), timeout=60) as connection:
        connection.sendall(head_text.encode())
        try:
            for at in range(0, len(data), 65536):
                part = data[at : at + 65536]
                connection.sendall(b"%x\r\n%s\r\n" % (len(part), part) if chunked else part)
        except (BrokenPipeError, ConnectionResetError):
            pass
        answer = b""
        while not answer.endswith(b"}") and (more := connection.recv(65536)):
            answer += more
    return answer


def test_a_client_that_sends_first_and_reads_later_reads_the_refusal(tmp_path):
    with serving(tmp_path / "data") as served:
        start = f"POST /api/v1/projects HTTP/1.1\r\nHost: 127.0.0.1:{served.port}\r\n"
        token = f"Authorization: Bearer {served.token}\r\n"
        data = b"x" * (20 * MEBIBYTE)
        stranger = exchange(served.port, f"{start}Content-Length: {len(data)}\r\n\r\n", data)
        assert b" 403 " in stranger.partition(b"\r\n")[0]
        assert b"link_required" in stranger
        huge = exchange(served.port, f"{start}{token}Content-Length: 1500000000\r\n\r\n", data)
        assert b" 413 " in huge.partition(b"\r\n")[0]
        assert b'"request_too_large"' in huge
        assert b"application/problem+json" in huge
        # The server reads no more of it than it discards.
        endless = exchange(
            served.port, f"{start}Transfer-Encoding: chunked\r\n\r\n", b"x" * (80 * MEBIBYTE), chunked=True
        )
        assert endless == b"" or b" 403 " in endless.partition(b"\r\n")[0]
        assert not [path for path in (tmp_path / "data").rglob("*") if path.stat().st_size > 10 * MEBIBYTE]
