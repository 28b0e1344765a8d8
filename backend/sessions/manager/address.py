"""Opens connections to the address of a manager, for all that speak with one.

    HOST:PORT               on this machine, without encryption
    unix:PATH               a unix socket, which a container's gate listens at
    wss://HOST:PORT#SHA256  TLS, with the SHA-256 of the manager's certificate in hexadecimal digits

The web server makes the certificate of a manager on another machine, for one session. So it trusts that one
certificate alone: no authority, no host name and no clock matters. It is checked in the handshake, before the
token is sent. The digest is a part of the address, since whatever has the address needs it.
"""

from __future__ import annotations

import hashlib
import http.client
import re
import ssl
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from websockets.asyncio.client import connect, unix_connect
from websockets.sync.client import connect as sync_connect
from websockets.sync.client import unix_connect as sync_unix_connect

from backend.sessions.keeper.unix_http import UnixHTTPConnection

if TYPE_CHECKING:
    from websockets.sync.client import ClientConnection

__all__ = [
    "Address",
    "UnknownAddressError",
    "http_connection",
    "open_socket",
    "open_sync_socket",
    "read_address",
]

_NETWORK: Final = re.compile(r"(?P<place>[0-9A-Za-z.\-]+:\d{1,5}|\[[0-9A-Fa-f:]+\]:\d{1,5})")
_SECURE: Final = re.compile(rf"wss://{_NETWORK.pattern}#(?P<digest>[0-9a-f]{{64}})")
_HOST: Final = "localhost"


class UnknownAddressError(OSError):
    """Raised when an address has no known form: no manager can be reached there."""


@dataclass(frozen=True, slots=True)
class Address:
    """An address in its parts: a path, or a place (HOST:PORT), which may have the digest of a certificate."""

    path: str = ""
    place: str = ""
    digest: str = ""

    def url(self, target: str) -> str:
        """Returns the address of a websocket."""
        return f"{'wss' if self.digest else 'ws'}://{self.place or _HOST}/{target}"

    def context(self) -> ssl.SSLContext | None:
        """Returns what checks the certificate of the manager; None without encryption."""
        return _pinned(self.digest) if self.digest else None


def read_address(text: str) -> Address:
    """Returns the parts of an address.

    Raises:
        UnknownAddressError: it is of no known form.
    """
    if text.startswith("unix:/"):
        return Address(path=text.removeprefix("unix:"))
    if found := _SECURE.fullmatch(text):
        return Address(place=found["place"], digest=found["digest"])
    if found := _NETWORK.fullmatch(text):
        return Address(place=found["place"])
    raise UnknownAddressError(f"“{text[:80]}” is not the address of a manager")


def open_socket(address: str, target: str, **options: Any) -> connect:
    """Opens a websocket of a manager; `options` are those of `websockets.asyncio.client.connect`.

    Raises:
        UnknownAddressError: the address is of no known form.
    """
    at = read_address(address)
    if at.path:
        return unix_connect(at.path, at.url(target), **options)
    return connect(at.url(target), proxy=None, ssl=at.context(), **options)


def open_sync_socket(address: str, target: str, **options: Any) -> ClientConnection:
    """Opens a websocket of a manager, for a thread.

    Raises:
        OSError: no manager listens there, or it is another one than the address names.
        websockets.exceptions.WebSocketException: the manager refused.
    """
    at = read_address(address)
    opened: ClientConnection
    if at.path:
        opened = sync_unix_connect(at.path, at.url(target), **options)
    else:
        opened = sync_connect(at.url(target), proxy=None, ssl=at.context(), **options)
    return opened


def http_connection(address: str, timeout_s: float) -> http.client.HTTPConnection:
    """Returns a connection to a manager's HTTP; it is opened by the first request.

    Raises:
        UnknownAddressError: the address is of no known form.
    """
    at = read_address(address)
    if at.path:
        return UnixHTTPConnection(at.path, timeout_s)
    context = at.context()
    if context is None:
        return http.client.HTTPConnection(at.place, timeout=timeout_s)
    return http.client.HTTPSConnection(at.place, timeout=timeout_s, context=context)


def _pinned(digest: str) -> ssl.SSLContext:
    """Returns a context that accepts one certificate, in the handshakes of threads and of asyncio."""

    def check(connection: ssl.SSLSocket | ssl.SSLObject) -> None:
        certificate = connection.getpeercert(binary_form=True) or b""
        if hashlib.sha256(certificate).hexdigest() != digest:
            raise ssl.SSLCertVerificationError("the manager has another certificate than its session")

    class PinnedSocket(ssl.SSLSocket):
        def do_handshake(self, block: bool = False) -> None:  # noqa: FBT001, FBT002 - of the base class
            super().do_handshake(block)
            check(self)

    class PinnedObject(ssl.SSLObject):
        def do_handshake(self) -> None:
            super().do_handshake()
            check(self)

    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE  # `check` accepts one certificate alone
    context.minimum_version = ssl.TLSVersion.TLSv1_3
    context.sslsocket_class = PinnedSocket
    context.sslobject_class = PinnedObject
    return context
