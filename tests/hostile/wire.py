"""Requests of a client that obeys no rule: raw, slow, endless or invalid."""

from __future__ import annotations

import asyncio
import base64
import http.cookiejar
import secrets
import struct
import urllib.request
from contextlib import asynccontextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import AsyncIterable, AsyncIterator, Mapping

PATIENCE_S = 60
"""How long an answer is waited for."""
Streams = tuple[asyncio.StreamReader, asyncio.StreamWriter]


@dataclass(frozen=True, slots=True)
class Site:
    """The server under attack, and the attacker's accounts.

    Attributes:
        host: where it listens.
        port: likewise.
        origin: as browsers name it.
        guest: the cookie of somebody who opened a read-only link.
        user: the cookie of the hostile user's own account; empty where they have none.
        project: what the guest may read, a large one.
        account: a name whose password is guessed.
    """

    host: str
    port: int
    origin: str
    guest: str
    user: str
    project: str
    account: str

    def head(self, method: str, path: str, headers: Mapping[str, str]) -> bytes:
        """Returns the head of a request; given headers replace the usual ones."""
        usual = {
            "Host": self.origin.partition("://")[2],
            "Origin": self.origin,
            "Cookie": self.guest,
            "Connection": "close",
        }
        lines = [f"{method} {path} HTTP/1.1", *(f"{k}: {v}" for k, v in (usual | dict(headers)).items())]
        return "\r\n".join([*lines, "", ""]).encode("latin-1")


def guest_cookie(link: str) -> str:
    """Returns the cookie of a guest who opens a read-only link."""
    jar = http.cookiejar.CookieJar()
    opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(jar))
    opener.open(link, timeout=PATIENCE_S).close()  # the link of a server of our own
    return "; ".join(f"{cookie.name}={cookie.value}" for cookie in jar)


@asynccontextmanager
async def connected(site: Site) -> AsyncIterator[Streams]:
    """Opens a connection that is dropped at the end, whatever is pending."""
    reader, writer = await asyncio.open_connection(site.host, site.port)
    try:
        yield reader, writer
    finally:
        writer.transport.abort()


async def status_of(reader: asyncio.StreamReader) -> str:
    """Returns the status of an answer after reading its body; otherwise the end of the connection."""
    async with asyncio.timeout(PATIENCE_S):
        line = await reader.readline()
        while await reader.read(1 << 16):
            pass
    return line.split()[1].decode() if line.startswith(b"HTTP/") else "closed"


async def ask(
    site: Site,
    method: str,
    path: str,
    body: bytes | AsyncIterable[bytes] = b"",
    **headers: str,
) -> str:
    """Sends one request; `headers` have `_` for `-`. A body in parts is sent while the server reads it."""
    given = {name.replace("_", "-"): value for name, value in headers.items()}
    if isinstance(body, bytes) and body:
        given.setdefault("Content-Length", str(len(body)))
    async with connected(site) as (reader, writer):
        writer.write(site.head(method, path, given) + (body if isinstance(body, bytes) else b""))
        answer = asyncio.ensure_future(status_of(reader))
        try:
            if not isinstance(body, bytes):
                await _send_parts(body, writer, answer)
            return await answer
        finally:
            answer.cancel()
            await asyncio.gather(answer, return_exceptions=True)


async def _send_parts(
    parts: AsyncIterable[bytes], writer: asyncio.StreamWriter, answer: asyncio.Future[str]
) -> None:
    async for part in parts:
        if answer.done():
            return
        writer.write(part)
        draining = asyncio.ensure_future(writer.drain())
        await asyncio.wait((draining, answer), return_when=asyncio.FIRST_COMPLETED)
        draining.cancel()
        if (await asyncio.gather(draining, return_exceptions=True))[0] is not None:
            return


def chunk(data: bytes) -> bytes:
    """Returns a part of a body without a length."""
    return b"%x\r\n%s\r\n" % (len(data), data)


@asynccontextmanager
async def websocket(site: Site, path: str, **headers: str) -> AsyncIterator[tuple[str, Streams]]:
    """Returns the status of a handshake, and the connection."""
    given = {
        "Connection": "Upgrade",
        "Upgrade": "websocket",
        "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": base64.b64encode(secrets.token_bytes(16)).decode(),
    } | headers
    async with connected(site) as (reader, writer):
        writer.write(site.head("GET", path, given))
        async with asyncio.timeout(PATIENCE_S):
            head = await reader.readuntil(b"\r\n\r\n")
        yield head.split()[1].decode(), (reader, writer)


def frame(data: bytes, *, opcode: int = 1, is_last: bool = True, says: int | None = None) -> bytes:
    """Returns a frame of a client; `says` is its stated length, whatever follows."""
    length = len(data) if says is None else says
    first = opcode | (0x80 if is_last else 0)
    if length < 126:
        head = struct.pack("!BB", first, 0x80 | length)
    elif length < 1 << 16:
        head = struct.pack("!BBH", first, 0x80 | 126, length)
    else:
        head = struct.pack("!BBQ", first, 0x80 | 127, length)
    return head + bytes(4) + data  # a mask of zeros changes nothing
