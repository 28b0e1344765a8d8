"""The first line of a stream: it names the socket of the host to which the stream is joined.

    bt-studio 1 keeper    the keeper
    bt-studio 1 <id>      a session, or a user's tools

The relay answers nothing: what follows is the stream. It closes a stream whose socket it does not have.
"""

from __future__ import annotations

import re
from typing import Final

__all__ = ["KEEPER", "MAX_HELLO_BYTES", "WrongHelloError", "read_hello", "socket_of", "write_hello"]

KEEPER: Final = "keeper"
MAX_HELLO_BYTES: Final = 64
_HELLO: Final = re.compile(rb"bt-studio 1 (keeper|[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12})\n")


class WrongHelloError(ValueError):
    """The first line of a stream names no socket."""


def write_hello(what: str) -> bytes:
    """Returns the line that names the keeper, or the session or tools with an id.

    Raises:
        WrongHelloError: it is neither.
    """
    line = f"bt-studio 1 {what}\n".encode()
    read_hello(line)
    return line


def read_hello(line: bytes) -> str:
    """Returns what a line names.

    Raises:
        WrongHelloError: it is no such line.
    """
    found = _HELLO.fullmatch(line)
    if found is None:
        raise WrongHelloError(f"{line[:MAX_HELLO_BYTES]!r} names no socket")
    return found[1].decode()


def socket_of(what: str) -> str:
    """Returns the path of a socket below the keeper's folder."""
    return "keeper.sock" if what == KEEPER else f"sessions/{what}.sock"
