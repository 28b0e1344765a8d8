"""Access rules of a manager, for both of its protocols. Pure.

A web page can reach every port of the machine that its browser runs on. With a token, only
the token counts: a page does not know it. Without one, a request must name this machine as its `Host`, which
refuses a page whose name resolves to 127.0.0.1 (DNS rebinding), and a page must be local or listed.
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
    """Why a request is refused."""

    status: HTTPStatus
    text: str


@dataclass(frozen=True, slots=True)
class Admission:
    """The rules of one manager.

    Attributes:
        token: required of clients; "" requires none, and only local clients are accepted.
        origins: pages that may connect, such as `https://example.org`.
    """

    token: str = field(default="", repr=False)
    origins: frozenset[str] = frozenset()

    def judge(self, request: Request, *, reads_health: bool = False) -> Refusal | None:
        """Returns why a request is refused, or None when it may pass.

        Args:
            request: the websocket request.
            reads_health: whether it is for `/health`, which probes read without a token.
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
        """Accepts a bearer token or one in the address: a page cannot send headers with a websocket."""
        expected = self.token.encode()
        scheme, _, bearer = _header(request, "Authorization").partition(" ")
        asked = parse_qs(urlsplit(request.path).query).get("token", [""])[0]
        given = bearer if scheme.lower() == "bearer" else asked
        return hmac.compare_digest(given.encode(errors="replace"), expected)


def is_loopback(host: str) -> bool:
    """Whether an address is reachable from this machine only."""
    with contextlib.suppress(ValueError):
        return ipaddress.ip_address(host).is_loopback
    return host == "localhost"


def _is_address(host: str) -> bool:
    """Whether a host is an address, or localhost; others could resolve any other name to this machine."""
    with contextlib.suppress(ValueError):
        ipaddress.ip_address(host)
        return True
    return host == "localhost"


def _header(request: Request, name: str) -> str:
    """Returns a header; one that is repeated matches nothing."""
    return ", ".join(request.headers.get_all(name))


def _name_of(url: str) -> str:
    """Returns the host of an address; "" if it cannot be read."""
    with contextlib.suppress(ValueError):
        return urlsplit(url).hostname or ""
    return ""
