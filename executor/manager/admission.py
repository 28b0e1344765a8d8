"""Who may talk to a manager, decided without any I/O; for both of its protocols.

A web page can reach every port of the machine that its browser runs on. With a token, what counts is the
token: a page does not know it. Without one, a request must name this machine as its `Host`, so that a page
whose name was made to point to 127.0.0.1 gets nothing, and a page must be of this machine or be listed.
"""

from __future__ import annotations

import contextlib
import hmac
import ipaddress
from dataclasses import dataclass, field
from http import HTTPStatus
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import parse_qs, urlsplit

if TYPE_CHECKING:
    from websockets.http11 import Request

__all__ = ["Admission", "Refusal", "is_loopback"]


class Refusal(NamedTuple):
    """Why a request goes no further."""

    status: HTTPStatus
    text: str


@dataclass(frozen=True, slots=True)
class Admission:
    """The rules of one manager.

    Attributes:
        token: what clients must show; "" asks for none, and then only this machine is answered.
        origins: pages that may drive it, such as `https://example.org`.
    """

    token: str = field(default="", repr=False)
    origins: frozenset[str] = frozenset()

    def judge(self, request: Request, *, reads_health: bool = False) -> Refusal | None:
        """Returns why a request is refused, or None when it may pass.

        Args:
            request: what came.
            reads_health: whether all that it asks is how the manager is, which probes ask without a token.
        """
        host = _name_of("//" + _header(request, "Host"))
        has_token = bool(self.token) and self._shows_token(request)
        if self.token and not has_token and not (reads_health and _is_address(host)):
            return Refusal(HTTPStatus.UNAUTHORIZED, "The token is missing or wrong.\n")
        if not self.token and not is_loopback(host):
            return Refusal(HTTPStatus.MISDIRECTED_REQUEST, "This manager answers on this machine only.\n")
        origin = _header(request, "Origin")
        if not origin or origin in self.origins or (not self.token and is_loopback(_name_of(origin))):
            return None
        text = f"Pages of {origin[:100]} may not drive this manager; --allow-origin lists those that may.\n"
        return Refusal(HTTPStatus.FORBIDDEN, text)

    def _shows_token(self, request: Request) -> bool:
        """As a bearer token, or in the address: a page can send no headers with a websocket."""
        expected = self.token.encode()
        scheme, _, bearer = _header(request, "Authorization").partition(" ")
        asked = parse_qs(urlsplit(request.path).query).get("token", [""])[0]
        given = bearer if scheme.lower() == "bearer" else asked
        return hmac.compare_digest(given.encode(errors="replace"), expected)


def is_loopback(host: str) -> bool:
    """Whether only programs of this machine can reach an address."""
    with contextlib.suppress(ValueError):
        return ipaddress.ip_address(host).is_loopback
    return host == "localhost"


def _is_address(host: str) -> bool:
    """Whether a host is no name that anybody could make to point here."""
    with contextlib.suppress(ValueError):
        ipaddress.ip_address(host)
        return True
    return host == "localhost"


def _header(request: Request, name: str) -> str:
    """A header; one that came twice is none of those that are allowed."""
    return ", ".join(request.headers.get_all(name))


def _name_of(url: str) -> str:
    """The host in an address; "" where it cannot be read."""
    with contextlib.suppress(ValueError):
        return urlsplit(url).hostname or ""
    return ""
