"""The program to follow, which the server names in a line of our standard input, after our start.

So the processes of an attached session have started while its user still writes the address.
"""

from __future__ import annotations

import asyncio
import os
import sys
from typing import TYPE_CHECKING, Final

import msgspec

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["LATER", "Order", "await_order"]

LATER: Final = "-"
"""Stands for the address of the program in the arguments of the manager."""
LONGEST: Final = 4096
"""The most bytes that a pipe takes, and gives, at once."""


class Order(msgspec.Struct):
    """The line that the server writes.

    Attributes:
        target: HOST:PORT of the program.
        recordings: the folder for the recordings, which stays; "" for one of the session.
    """

    target: str
    recordings: str = ""


def await_order(follow: Callable[[Order], None], end: Callable[[str], None]) -> None:
    """Passes the order on when it comes; ends the session for a line that cannot be read."""
    loop = asyncio.get_running_loop()
    source = sys.stdin.fileno()

    def read() -> None:
        loop.remove_reader(source)
        line = os.read(source, LONGEST)
        if not line:
            return  # the server has ended, and soon this process
        try:
            order = msgspec.json.decode(line, type=Order)
        except msgspec.DecodeError as error:
            end(f"cannot read what to follow: {error}")
        else:
            follow(order)

    loop.add_reader(source, read)
