"""Bodies over real connections: without a length, with a wrong one, too slow, too large, or invalid."""

from __future__ import annotations

import json
import socket
from contextlib import ExitStack, suppress

import pytest

from tests.backend.serving import serving

MEBIBYTE = 1024 * 1024
SLOW = 150


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    folder = tmp_path_factory.mktemp("data")
    with serving(folder, BT_STUDIO_MAX_REQUEST_BYTES=str(2 * MEBIBYTE)) as found:
        yield found


def connected(served):
    return socket.create_connection(("127.0.0.1", served.port), timeout=60)


def head_of(served, method, path, *lines, token=True):
    rows = [f"{method} {path} HTTP/1.1", f"Host: 127.0.0.1:{served.port}", *lines]
    rows += [f"Authorization: Bearer {served.token}"] if token else []
    return "\r\n".join([*rows, "", ""]).encode()


def chunks(data, size=65536):
    parts = (data[at : at + size] for at in range(0, len(data), size))
    return b"".join(b"%x\r\n%s\r\n" % (len(part), part) for part in parts) + b"0\r\n\r\n"


def send(connection, data):
    """Sends as much as the server accepts."""
    with suppress(BrokenPipeError, ConnectionResetError):
        connection.sendall(data)


def answer(connection):
    """Returns status, headers, body, and whether the server says that it closes the connection."""
    data = b""
    while b"\r\n\r\n" not in data:
        more = connection.recv(65536)
        if not more:
            return 0, {}, data, True
        data += more
    head, _, body = data.partition(b"\r\n\r\n")
    first, *rows = head.decode().split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (row.partition(":") for row in rows)}
    status, is_closed = int(first.split()[1]), headers.get("connection") == "close"
    if headers.get("transfer-encoding") == "chunked":
        while not body.endswith(b"0\r\n\r\n"):
            body += connection.recv(65536)
        return status, headers, whole(body), is_closed
    length = int(headers["content-length"])
    while len(body) < length:
        body += connection.recv(65536)
    return status, headers, body[:length], is_closed  # the rest answers data that were sent after the request


def whole(chunked):
    """Returns a body that came in chunks."""
    body = b""
    while size := int(chunked.partition(b"\r\n")[0], 16):
        _, _, rest = chunked.partition(b"\r\n")
        body, chunked = body + rest[:size], rest[size + 2 :]
    return body


def exchange(served, data, *, ends=False):
    with connected(served) as connection:
        send(connection, data)
        if ends:
            connection.shutdown(socket.SHUT_WR)
        return answer(connection)


def is_served(served):
    """Returns whether another client is served."""
    with connected(served) as connection:
        send(connection, head_of(served, "GET", "/api/v1/projects"))
        return answer(connection)[0] == 200


def refused(found, status, code):
    got, headers, body, is_closed = found
    assert (got, headers.get("content-type"), is_closed) == (status, "application/problem+json", True), found
    document = json.loads(body)
    assert (document["status"], document["code"]) == (status, code)
    assert document["detail"]
    return True


CHUNKED = "Transfer-Encoding: chunked"


def test_a_body_without_a_length_is_counted(served):
    start = head_of(served, "POST", "/api/v1/projects", CHUNKED, "Content-Type: application/json")
    assert exchange(served, start + chunks(b'{"name": "Chunked"}'))[0] == 201
    assert refused(exchange(served, start + chunks(b"x" * 3 * MEBIBYTE)), 413, "request_too_large")
    stranger = head_of(served, "POST", "/api/v1/projects", CHUNKED, token=False)
    assert refused(exchange(served, stranger + chunks(b"x" * 3 * MEBIBYTE)), 403, "link_required")
    assert is_served(served)


def test_after_a_refusal_the_connection_is_closed(served):
    with connected(served) as connection:
        send(connection, head_of(served, "POST", "/api/v1/projects", "Content-Length: 3000000"))
        assert refused(answer(connection), 413, "request_too_large")
        send(connection, b"x" * 3_000_000)  # the server discards the rest of the body
        assert connection.recv(1) == b""


def test_a_length_that_is_too_large_is_refused_at_once(served):
    for path in ("/api/v1/projects", "/api/v1/projects/import", "/accounts/login/", "/nothing/at/all"):
        with connected(served) as connection:
            send(connection, head_of(served, "POST", path, "Content-Length: 1500000000"))
            # Nothing was sent, but there is an answer.
            assert refused(answer(connection), 413, "request_too_large")


def test_a_length_that_is_too_small_says_where_the_body_ends(served):
    start = head_of(
        served, "POST", "/api/v1/projects", "Content-Length: 18", "Content-Type: application/json"
    )
    # The data after it are not a request; this ends the connection, perhaps before the answer.
    assert exchange(served, start + b'{"name": "Length"}' + b"x" * 100_000)[0] in {201, 400}
    assert is_served(served)


def test_a_body_that_ends_too_early_is_forgotten(served):
    start = head_of(
        served, "POST", "/api/v1/projects", "Content-Length: 1000", "Content-Type: application/json"
    )
    assert exchange(served, start + b'{"name": "Early"}', ends=True) == (0, {}, b"", True)
    with connected(served) as connection:
        send(connection, head_of(served, "GET", "/api/v1/projects"))
        names = [item["name"] for item in json.loads(answer(connection)[2])["items"]]
    assert "Early" not in names


@pytest.mark.parametrize(
    "lines",
    [
        ("Content-Length: 5", "Content-Length: 6"),
        ("Content-Length: -1",),
        ("Content-Length: 1e3",),
        ("Content-Length: 5", CHUNKED),
        ("Transfer-Encoding: gzip, chunked, gzip",),
    ],
)
def test_two_lengths_or_none_that_is_one_are_no_request(served, lines):
    """Otherwise a proxy and the server could see two different requests in the same bytes."""
    status, *_ = exchange(served, head_of(served, "POST", "/api/v1/projects", *lines) + b"12345")
    assert status == 400
    assert is_served(served)


def test_routes_that_take_no_body_have_the_same_bounds(served):
    small = head_of(served, "GET", "/api/v1/projects", "Content-Length: 5") + b"12345"
    assert exchange(served, small)[0] == 200
    for method in ("GET", "DELETE", "OPTIONS"):
        huge = head_of(served, method, "/api/v1/projects", "Content-Length: 1500000000")
        assert refused(exchange(served, huge), 413, "request_too_large")
        endless = head_of(served, method, "/api/v1/projects", CHUNKED) + chunks(b"x" * 3 * MEBIBYTE)
        assert refused(exchange(served, endless), 413, "request_too_large")
    assert is_served(served)


def test_many_who_send_slowly_hold_up_nobody(served):
    """These requests wait in the event loop: they get a thread only when their body is complete."""
    start = head_of(
        served, "POST", "/api/v1/projects", "Content-Length: 1000", "Content-Type: application/json"
    )
    with ExitStack() as stack:
        slow = [stack.enter_context(connected(served)) for _ in range(SLOW)]
        for connection in slow:
            send(connection, start + b"{")
        for _ in range(20):
            assert is_served(served)
        for connection in slow[::10]:
            send(connection, b" " * 998 + b"}")
            assert answer(connection)[0] == 201
