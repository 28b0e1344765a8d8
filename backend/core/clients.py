"""Decides from which address a request comes, and whether a proxy forwarded it."""

from __future__ import annotations

import logging
from ipaddress import IPv6Address, IPv6Network, ip_address
from typing import TYPE_CHECKING, Final

from backend.config.environment import environment

if TYPE_CHECKING:
    from collections.abc import Mapping

log = logging.getLogger(__name__)

FORWARDED: Final = ("x-forwarded-for", "forwarded", "x-real-ip", "x-forwarded-proto")
"""Headers that proxies add. Any client can send them too, so they do not prove that there is a proxy."""
_UNBELIEVED: Final = (
    "Requests come through a reverse proxy (they have the header %s), but BT_STUDIO_PROXY_HOPS is 0: all "
    "users seem to come from one address, the proxy's. Set it to the number of proxies in front."
)
_EXPECTED: Final = (
    "BT_STUDIO_PUBLIC_URL is an https address, so a reverse proxy does TLS, but BT_STUDIO_PROXY_HOPS is 0: "
    "all users will seem to come from one address, the proxy's. Set it to the number of proxies in front."
)


def address_of(connection: str | None, headers: Mapping[str, str]) -> str | None:
    """Returns the client's address: the one that the outermost trusted proxy added, or the connection's.

    Args:
        connection: the address at the other end of the connection.
        headers: the headers of the request, by their names in lower case.
    """
    hops = environment().proxy_hops
    forwarded = [part.strip() for part in headers.get("x-forwarded-for", "").split(",")]
    address = forwarded[-hops] if 0 < hops <= len(forwarded) and forwarded[-hops] else connection or ""
    try:
        return str(ip_address(address))
    except ValueError:
        return None


def network_of(address: str | None) -> str:
    """Returns the network that counts as one address.

    For IPv6 it is the /64, since one machine can use all of it.
    """
    if not address:
        return "?"
    found = ip_address(address)
    if isinstance(found, IPv6Address):
        return str(IPv6Network((found, 64), strict=False).network_address)
    return str(found)


def stranger(address: str | None) -> str:
    """Returns the owner of the resources that unidentified clients use: one owner for each address."""
    return f"address {network_of(address)}"


def is_on_this_machine(connection: str | None, headers: Mapping[str, str]) -> bool:
    """Returns whether a program on this machine sent the request for itself, not as a proxy."""
    if any(name in headers for name in FORWARDED):
        return False
    try:
        return ip_address(connection or "").is_loopback
    except ValueError:
        return False


class _Proxies:
    """Warns once about a proxy that the settings do not name."""

    def __init__(self) -> None:
        self.is_said = False

    def at_start(self) -> None:
        """Warns at the start if the public address uses https but no proxy is configured."""
        settings = environment()
        if settings.is_team and settings.is_https and not settings.proxy_hops:
            log.warning(_EXPECTED)

    def see(self, headers: Mapping[str, str]) -> None:
        """Warns at the first request that has a header of a proxy."""
        if self.is_said or environment().proxy_hops or not environment().is_team:
            return
        name = next((name for name in FORWARDED if name in headers), None)
        if name is not None:
            self.is_said = True
            log.warning(_UNBELIEVED, name)


proxies: Final = _Proxies()
