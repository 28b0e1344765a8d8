"""Addresses of programs that a session follows."""

from __future__ import annotations

from backend.sessions.errors import AddressError
from tree_gardener.groot import GrootError
from tree_gardener.groot.client import read_address

__all__ = ["read_target"]


def read_target(address: str) -> str:
    """Returns HOST:PORT of an address as a user writes it.

    Raises:
        AddressError: it is something else, such as an address of ZeroMQ's own.
    """
    try:
        host, port = read_address(address.strip())
    except GrootError as error:
        raise AddressError(
            str(error), hint="The port of Groot2's publisher is 1667 if none is set."
        ) from error
    return f"{host.lower()}:{port}"
