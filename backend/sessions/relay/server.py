"""The loop of the relay: admits connections, ends TLS, and joins each stream to the socket that it names.

Any program that reaches the port may connect. So a connection has a few seconds to show its certificate and
to name its socket; those that have not are few, and the oldest gives way to a new one.
"""

from __future__ import annotations

import asyncio
import logging
import socket
import ssl
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from backend.sessions.relay.hello import MAX_HELLO_BYTES, WrongHelloError, read_hello, socket_of
from backend.sessions.relay.tls import WEB, Bundle, BundleError, has_role

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["Limits", "Relay", "keep_alive"]

log = logging.getLogger(__name__)

BUFFER_BYTES: Final = 64 * 1024
BACK_OFF_S: Final = 0.05
LOG_EVERY_S: Final = 10.0
_UNANSWERED_MS: Final = 30_000
# A peer whose machine or network is gone sends no end of its stream.
_KEPT_ALIVE: Final = (
    (socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1),
    (socket.IPPROTO_TCP, socket.TCP_KEEPIDLE, 15),
    (socket.IPPROTO_TCP, socket.TCP_KEEPINTVL, 5),
    (socket.IPPROTO_TCP, socket.TCP_KEEPCNT, 3),
    (socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, _UNANSWERED_MS),
    (socket.IPPROTO_TCP, socket.TCP_NODELAY, 1),
)

Stream = tuple[asyncio.StreamReader, asyncio.StreamWriter]


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits of the relay; a stream needs two descriptors.

    Attributes:
        streams: connections in all.
        callers: connections that have not named their socket yet.
        hello_s: seconds in which a connection must have done so.
        closing_s: seconds in which the end of a stream must have taken what was on its way.
    """

    streams: int = 1024
    callers: int = 64
    hello_s: float = 5
    closing_s: float = 5


class RefusedError(Exception):
    """A connection is not let in."""


def keep_alive(connection: socket.socket) -> None:
    """Makes a connection end by itself when its other end has been silent for half a minute."""
    for level, name, value in _KEPT_ALIVE:
        connection.setsockopt(level, name, value)


class Relay:
    """Joins streams of web servers to the sockets of this host.

    Args:
        bundle: the certificate of this host.
        folder: the folder with the sockets of the keeper and of the sessions.
    """

    def __init__(self, bundle: Bundle, folder: Path, limits: Limits = Limits()) -> None:
        self._bundle = bundle
        self._folder = folder
        self._limits = limits
        self._callers: dict[asyncio.Task[None], None] = {}
        self._joined: set[asyncio.Task[None]] = set()
        self._dropped: Counter[str] = Counter()

    async def serve(self, listener: socket.socket) -> None:
        """Serves until it is cancelled; then all streams end."""
        listener.settimeout(0)
        reporting = asyncio.create_task(self._report())
        try:
            while True:
                await self._admit(listener)
        finally:
            tasks = [reporting, *self._callers, *self._joined]
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    async def _admit(self, listener: socket.socket) -> None:
        try:
            connection, _ = await asyncio.get_running_loop().sock_accept(listener)
        except OSError as error:  # no descriptors are left, or the caller has gone
            self._note(f"not accepted: {error.strerror}")
            self._give_way()
            await asyncio.sleep(BACK_OFF_S)
            return
        if len(self._callers) >= self._limits.callers:
            self._give_way()
        if len(self._callers) + len(self._joined) >= self._limits.streams:
            self._note("all streams are taken")
            connection.close()
            return
        task = asyncio.create_task(self._handle(connection))
        self._callers[task] = None
        task.add_done_callback(self._forget)

    def _give_way(self) -> None:
        """Closes the oldest connection that has not named its socket."""
        oldest = next(iter(self._callers), None)
        if oldest is not None:
            self._note("gave way")
            self._callers.pop(oldest)
            oldest.cancel()

    def _forget(self, task: asyncio.Task[None]) -> None:
        self._callers.pop(task, None)
        self._joined.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            log.error("a stream failed", exc_info=error)

    async def _handle(self, connection: socket.socket) -> None:
        try:
            async with asyncio.timeout(self._limits.hello_s):
                outer = await self._secure(connection)
                try:
                    inner = await self._open(outer)
                except BaseException:
                    outer[1].transport.abort()
                    raise
        except TimeoutError:
            self._note("too slow")
        except (RefusedError, BundleError) as error:
            self._note(str(error))
        except ssl.SSLError as error:
            self._note(f"TLS: {error.reason or error}")
        except OSError as error:
            self._note(f"went away: {error.strerror or error}")
        else:
            if (task := asyncio.current_task()) is not None and task in self._callers:
                self._joined.add(task)
                del self._callers[task]
            await self._join(outer, inner)
        finally:
            connection.close()

    async def _secure(self, connection: socket.socket) -> Stream:
        loop = asyncio.get_running_loop()
        connection.settimeout(0)
        keep_alive(connection)
        reader = asyncio.StreamReader(limit=BUFFER_BYTES)
        protocol = asyncio.StreamReaderProtocol(reader)
        transport, _ = await loop.connect_accepted_socket(
            lambda: protocol,
            connection,
            ssl=self._bundle.context(),
            ssl_handshake_timeout=self._limits.hello_s,
            ssl_shutdown_timeout=self._limits.closing_s,
        )
        return reader, asyncio.StreamWriter(transport, protocol, reader, loop)

    async def _open(self, outer: Stream) -> Stream:
        """Opens the socket that a stream names.

        Raises:
            RefusedError: the caller is no web server, or there is no such socket.
        """
        reader, writer = outer
        if not has_role(writer.get_extra_info("peercert"), WEB):
            raise RefusedError("a certificate without the role of a web server")
        try:
            what = read_hello(await _line(reader))
        except (WrongHelloError, asyncio.IncompleteReadError):
            raise RefusedError("no hello") from None
        try:
            return await asyncio.open_unix_connection(self._folder / socket_of(what), limit=BUFFER_BYTES)
        except OSError as error:
            raise RefusedError(f"no socket: {error.strerror}") from error

    async def _join(self, outer: Stream, inner: Stream) -> None:
        pumps = [
            asyncio.create_task(_pump(outer[0], inner[1])),
            asyncio.create_task(_pump(inner[0], outer[1])),
        ]
        try:
            # TLS has no half of a stream: one end ends the other.
            await asyncio.wait(pumps, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for pump in pumps:
                pump.cancel()
            await asyncio.gather(*pumps, return_exceptions=True)
            await asyncio.gather(self._end(outer[1]), self._end(inner[1]))

    async def _end(self, writer: asyncio.StreamWriter) -> None:
        writer.close()
        try:
            async with asyncio.timeout(self._limits.closing_s):
                with suppress(OSError):
                    await writer.wait_closed()
        except TimeoutError:
            pass
        finally:
            writer.transport.abort()

    def _note(self, why: str) -> None:
        self._dropped[why] += 1

    async def _report(self) -> None:
        while True:
            await asyncio.sleep(LOG_EVERY_S)
            if self._dropped:
                log.warning("connections dropped: %s", dict(self._dropped))
                self._dropped.clear()


async def _line(reader: asyncio.StreamReader) -> bytes:
    """Returns the first line; what follows it stays in the reader."""
    line = b""
    while not line.endswith(b"\n"):
        if len(line) >= MAX_HELLO_BYTES:
            raise WrongHelloError("the line is too long")
        line += await reader.readexactly(1)
    return line


async def _pump(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    """Passes on bytes until either end is reached, as fast as they are taken."""
    with suppress(OSError):
        while data := await reader.read(BUFFER_BYTES):
            writer.write(data)
            await writer.drain()
