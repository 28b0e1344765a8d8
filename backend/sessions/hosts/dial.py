"""Opens streams to sockets of hosts, through their relays."""

from __future__ import annotations

import http.client
import socket
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from websockets.asyncio.client import ClientConnection

from backend.config.environment import environment
from backend.sessions.hosts.authority import WEB_BUNDLE
from backend.sessions.relay.hello import write_hello
from backend.sessions.relay.server import keep_alive
from backend.sessions.relay.tls import Bundle, client_context

if TYPE_CHECKING:
    import asyncio
    import ssl

    from backend.sessions.hosts.names import HostAddress

__all__ = ["NotReachedError", "RelayedHTTPConnection", "dial", "greeting", "web_bundle"]


class NotReachedError(OSError):
    """A stream to a host could not be opened, so that nothing was asked of it."""


@lru_cache(maxsize=1)
def web_bundle() -> Bundle:
    """Returns the certificate of this web server."""
    return Bundle(environment().hosts_folder / WEB_BUNDLE, client_context)


def dial(host: HostAddress, what: str, timeout_s: float) -> ssl.SSLSocket:
    """Returns a stream to the keeper, or to the session or tools with an id, of a host.

    Whether there is such a socket is known when something is read.

    Raises:
        NotReachedError: the host's relay does not answer, or has another certificate.
    """
    try:
        plain = socket.create_connection((host.name, host.port), timeout_s)
        try:
            keep_alive(plain)
            secure = web_bundle().context().wrap_socket(plain, server_hostname=host.name)
        except BaseException:
            plain.close()
            raise
        try:
            secure.sendall(write_hello(what))
        except BaseException:
            secure.close()
            raise
    except OSError as error:
        raise NotReachedError(f"the host {host} is not reached: {error}") from error
    return secure


class RelayedHTTPConnection(http.client.HTTPConnection):
    """A connection to the HTTP of a socket of a host."""

    def __init__(
        self, host: HostAddress, what: str, timeout_s: float, connect_s: float | None = None
    ) -> None:
        super().__init__("localhost", timeout=timeout_s)
        self._at = host
        self._what = what
        self._timeout_s = timeout_s
        self._connect_s = timeout_s if connect_s is None else connect_s

    def connect(self) -> None:
        """Connects; called by the base class.

        Raises:
            NotReachedError: the host does not answer.
        """
        self.sock = dial(self._at, self._what, self._connect_s)
        self.sock.settimeout(self._timeout_s)


def greeting(what: str) -> type[ClientConnection]:
    """Returns the class of websockets that name a socket to the relay, before they speak to it."""
    hello = write_hello(what)

    class Greeting(ClientConnection):
        def connection_made(self, transport: asyncio.BaseTransport) -> None:
            made: Any = transport
            if (plain := made.get_extra_info("socket")) is not None:
                keep_alive(plain)
            made.write(hello)
            super().connection_made(transport)

    return Greeting
