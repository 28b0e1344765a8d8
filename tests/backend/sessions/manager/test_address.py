"""Where a manager listens: each kind of address is opened by threads, by asyncio and as HTTP."""

from __future__ import annotations

import asyncio
import hashlib
import ssl
from typing import TYPE_CHECKING, Any

import pytest
from websockets.asyncio.server import serve, unix_serve

from backend.sessions.manager.address import (
    Address,
    UnknownAddressError,
    http_connection,
    open_socket,
    open_sync_socket,
    read_address,
)
from backend.sessions.manager.certificate import make_certificate

if TYPE_CHECKING:
    from collections.abc import AsyncIterator
    from pathlib import Path

DIGEST = "0" * 64
MADE_ID = "0f6a1a8f-1d0a-4c5e-9b57-6f0b2f0e6c11"


class Listener:
    """A manager's server, which answers with the path that was asked for, and counts requests."""

    def __init__(self) -> None:
        self.address = ""
        self.asked: list[str] = []

    async def serve(self, socket) -> None:
        await socket.send(socket.request.path)

    def answer(self, connection, request):
        self.asked.append(request.path)
        return connection.respond(200, "well") if request.path == "/health" else None


@pytest.fixture(params=["tcp", "unix", "tls"])
async def listener(request: pytest.FixtureRequest, tmp_path: Path) -> AsyncIterator[Listener]:
    made = Listener()
    options: dict[str, Any] = {"process_request": made.answer}
    if request.param == "unix":
        made.address = f"unix:{tmp_path / 'manager'}"
        server = unix_serve(made.serve, str(tmp_path / "manager"), **options)
    else:
        context, scheme, pin = None, "", ""
        if request.param == "tls":
            context, digest = tls(tmp_path)
            scheme, pin = "wss://", f"#{digest}"
        server = serve(made.serve, "127.0.0.1", 0, ssl=context, **options)
    async with server as running:
        if not made.address:
            made.address = f"{scheme}127.0.0.1:{next(iter(running.sockets)).getsockname()[1]}{pin}"
        yield made


def tls(folder: Path) -> tuple[ssl.SSLContext, str]:
    made = make_certificate("session")
    (folder / "tls.crt").write_text(made.certificate)
    (folder / "tls.key").write_text(made.key)
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(folder / "tls.crt", folder / "tls.key")
    assert made.digest == hashlib.sha256(ssl.PEM_cert_to_DER_cert(made.certificate)).hexdigest()
    return context, made.digest


async def test_a_manager_is_reached_in_all_ways(listener: Listener) -> None:
    async with open_socket(listener.address, "control?a=1") as socket:
        assert await socket.recv() == "/control?a=1"

    def from_a_thread() -> tuple[str, int, bytes]:
        with open_sync_socket(listener.address, "stream") as socket:
            heard = str(socket.recv())
        connection = http_connection(listener.address, 5)
        connection.request("GET", "/health")
        with connection.getresponse() as answer:
            told = answer.status, answer.read()
        connection.close()
        return heard, *told

    assert await asyncio.to_thread(from_a_thread) == ("/stream", 200, b"well")


@pytest.mark.parametrize("listener", ["tls"], indirect=True)
async def test_a_manager_with_another_certificate_receives_nothing(listener: Listener) -> None:
    other = f"{listener.address.partition('#')[0]}#{make_certificate('other').digest}"
    with pytest.raises(ssl.SSLCertVerificationError, match="another certificate"):
        async with open_socket(other, "control", additional_headers={"Authorization": "Bearer secret"}):
            pass
    with pytest.raises(ssl.SSLCertVerificationError, match="another certificate"):
        await asyncio.to_thread(open_sync_socket, other, "control")
    with pytest.raises(ssl.SSLCertVerificationError, match="another certificate"):
        await asyncio.to_thread(http_connection(other, 5).request, "GET", "/health")
    assert listener.asked == []


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("127.0.0.1:7163", Address(place="127.0.0.1:7163")),
        ("[fd00::1]:7163", Address(place="[fd00::1]:7163")),
        ("unix:/run/s/1.sock", Address(path="/run/s/1.sock")),
        (f"wss://10.1.2.3:7163#{DIGEST}", Address(place="10.1.2.3:7163", digest=DIGEST)),
    ],
)
def test_addresses_are_read(text: str, address: Address) -> None:
    assert read_address(text) == address


@pytest.mark.parametrize(
    "text",
    [
        "",
        "127.0.0.1",
        "unix:",
        "unix:relative",
        "wss://10.1.2.3:7163",  # without a digest anybody could answer
        f"wss://10.1.2.3:7163#{DIGEST[1:]}",
        f"ws://10.1.2.3:7163#{DIGEST}",
        f"wss://ada@10.1.2.3:7163#{DIGEST}",
        "10.1.2.3:7163/other",
        f"tls://robots.lan:7164/{MADE_ID}",  # a further machine of an earlier release
        "10.1.2.3:7163\r\nX: y",
    ],
)
def test_what_is_no_address_is_refused(text: str) -> None:
    with pytest.raises(UnknownAddressError, match="is not the address of a manager"):
        read_address(text)
