"""Access rules of a manager, for both of its protocols. Pure.

A web page can reach every port of the machine on which its browser runs. If the manager has a token, only the
token is checked, since a foreign page does not know it. Without a token, the `Host` of a request must be this
machine, which excludes pages whose name resolves to 127.0.0.1 (DNS rebinding), and the page's origin must be
local or listed.
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
    """The reason for which a request is refused."""

    status: HTTPStatus
    text: str


@dataclass(frozen=True, slots=True)
class Admission:
    """The rules of one manager.

    Attributes:
        token: the token that clients must send; with "" none is needed, and only local clients are accepted.
        origins: pages that may connect, such as `https://example.org`.
    """

    token: str = field(default="", repr=False)
    origins: frozenset[str] = frozenset()

    def judge(self, request: Request, *, reads_health: bool = False) -> Refusal | None:
        """Returns the reason to refuse a request, or None if it is accepted.

        Args:
            request: the websocket request.
            reads_health: whether the request is for `/health`, which needs no token.
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
        """Returns whether a request has the token.

        It is a bearer token or in the address, since a page cannot set headers of a websocket.
        """
        expected = self.token.encode()
        scheme, _, bearer = _header(request, "Authorization").partition(" ")
        asked = parse_qs(urlsplit(request.path).query).get("token", [""])[0]
        given = bearer if scheme.lower() == "bearer" else asked
        return hmac.compare_digest(given.encode(errors="replace"), expected)


def is_loopback(host: str) -> bool:
    """Returns whether an address is reachable from this machine only."""
    with contextlib.suppress(ValueError):
        return ipaddress.ip_address(host).is_loopback
    return host == "localhost"


def _is_address(host: str) -> bool:
    """Returns whether a host is an IP address or localhost; any other name could resolve to this machine."""
    with contextlib.suppress(ValueError):
        ipaddress.ip_address(host)
        return True
    return host == "localhost"


def _header(request: Request, name: str) -> str:
    """Returns the value of a header; a value that matches nothing if the header is repeated."""
    return ", ".join(request.headers.get_all(name))


def _name_of(url: str) -> str:
    """Returns the host name of an URL; "" if it cannot be parsed."""
    with contextlib.suppress(ValueError):
        return urlsplit(url).hostname or ""
    return ""
