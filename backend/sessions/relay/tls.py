"""The certificates of web server and relay, as the standard library reads them.

Each end has one file, its *bundle*: its private key, its certificate, and the certificate of the authority
that signed both ends (`backend.sessions.hosts.authority` makes it). The relay admits certificates of clients
with the role of a web server; the web server admits certificates of servers with the name of the host.
"""

from __future__ import annotations

import logging
import re
import ssl
import threading
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

__all__ = ["HOST", "WEB", "Bundle", "BundleError", "client_context", "has_role", "role_uri", "server_context"]

log = logging.getLogger(__name__)

WEB: Final = "web"
HOST: Final = "host"
_CERTIFICATE: Final = re.compile(r"-----BEGIN CERTIFICATE-----\n.+?\n-----END CERTIFICATE-----\n", re.DOTALL)


class BundleError(OSError):
    """A bundle is missing or cannot be used; the text says what to do."""


def role_uri(role: str) -> str:
    """Returns the name in a certificate that gives it a role."""
    return f"urn:bt-studio:role:{role}"


def has_role(certificate: Mapping[str, Any] | None, role: str) -> bool:
    """Returns whether a certificate, as `getpeercert` returns it, has a role."""
    names = (certificate or {}).get("subjectAltName", ())
    return ("URI", role_uri(role)) in names


def server_context(bundle: Path) -> ssl.SSLContext:
    """Returns what a relay shows, and demands of its clients.

    Raises:
        BundleError: the bundle cannot be used.
    """
    context = _context(ssl.PROTOCOL_TLS_SERVER, bundle)
    context.num_tickets = 0  # each connection shows its certificate
    return context


def client_context(bundle: Path) -> ssl.SSLContext:
    """Returns what a web server shows, and demands of relays; each connection names the host that it expects.

    Raises:
        BundleError: the bundle cannot be used.
    """
    context = _context(ssl.PROTOCOL_TLS_CLIENT, bundle)
    context.check_hostname = True
    return context


def _context(protocol: ssl._SSLMethod, bundle: Path) -> ssl.SSLContext:
    context = ssl.SSLContext(protocol)
    context.minimum_version = ssl.TLSVersion.TLSv1_3
    try:
        found = _CERTIFICATE.findall(bundle.read_text(encoding="ascii"))
        if len(found) != 2:
            raise ValueError(f"it has {len(found)} certificates, and should have its own and the authority's")
        context.load_cert_chain(bundle)
        context.load_verify_locations(cadata=found[1])
    except (OSError, ValueError) as error:
        raise BundleError(
            f"{bundle} cannot be used: {error}. `bt-studio hosts certificate` makes it."
        ) from error
    context.verify_mode = ssl.CERT_REQUIRED
    return context


class Bundle:
    """A bundle on disk and its context, which follows the file: a renewed one needs no restart.

    Args:
        path: the file.
        read: `server_context` or `client_context`.
    """

    def __init__(self, path: Path, read: Callable[[Path], ssl.SSLContext]) -> None:
        self.path = path
        self._read = read
        self._lock = threading.Lock()
        self._seen: tuple[int, int, int] | None = None
        self._context: ssl.SSLContext | None = None

    def context(self) -> ssl.SSLContext:
        """Returns the context of the file as it is now. While the new file is damaged, the last one counts.

        Raises:
            BundleError: there was no usable file yet.
        """
        with self._lock:
            try:
                found = self.path.stat()
                seen = (found.st_mtime_ns, found.st_size, found.st_ino)
            except OSError:
                seen = None
            if self._context is None or seen != self._seen:
                try:
                    self._context = self._read(self.path)
                except BundleError as error:
                    if self._context is None:
                        raise
                    log.warning("the certificate stays as it was: %s", error)
                self._seen = seen
            return self._context
