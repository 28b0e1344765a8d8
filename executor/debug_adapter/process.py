"""debugpy's adapter for the manager: `python -m executor.debug_adapter.process --channel-fd N`.

The adapter is started here instead of by `python -m debugpy.adapter`, for two reasons (debugpy 1.8): that
program has its token in its arguments, where every user of the machine can read it, and it listens for
other debuggers on a port. Here the token comes through the channel, and the only port is that on which the
application connects. The request `attach` has no `listen`, with which the adapter forgets the token.
"""

from __future__ import annotations

import argparse
import os
import socket
import sys
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.adapter_messages import AdapterText, FromAdapter, StartAdapter, ToAdapter, decode_to_adapter
from executor.child_messages import Stop
from executor.debug_adapter.framing import FramingError, framed, read_framed
from executor.supervision.channel import Channel, ChannelClosed, ChannelError
from executor.supervision.confine import die_with_parent

if TYPE_CHECKING:
    from typing import NoReturn

__all__ = ["main"]

GOODBYE_S: Final = 1.0


def _start_debugpy(end: socket.socket, token: str) -> None:
    """Starts debugpy for one client at the other end of a socket pair."""
    from debugpy import adapter  # noqa: PLC0415 - slow, and only for this process
    from debugpy.adapter import clients  # noqa: PLC0415 - as above

    ours: Any = adapter
    theirs: Any = clients
    ours.access_token = token
    theirs.listener = None
    theirs.Client(end)


def _forward(end: socket.socket, channel: Channel[FromAdapter, ToAdapter]) -> NoReturn:
    """Sends the manager what the adapter says, until the adapter ends."""
    try:
        with end.makefile("rb") as source:
            while (text := read_framed(source)) is not None:
                channel.send(AdapterText(text))
    except (FramingError, ChannelClosed, OSError):
        os._exit(1)
    os._exit(0)


def _serve(channel: Channel[FromAdapter, ToAdapter]) -> None:
    message = channel.receive()
    if not isinstance(message, StartAdapter):
        return
    ours, theirs = socket.socketpair()
    _start_debugpy(theirs, message.token)
    threading.Thread(target=_forward, args=(ours, channel), name="adapter", daemon=True).start()
    while not isinstance(message := channel.receive(), Stop):
        if isinstance(message, AdapterText):
            ours.sendall(framed(message.text))
    ours.shutdown(socket.SHUT_WR)
    time.sleep(GOODBYE_S)  # the other thread ends the process once debugpy has said the last word


def main(arguments: list[str] | None = None) -> None:
    """Runs the adapter for the manager at the other end of a channel."""
    parser = argparse.ArgumentParser(prog="python -m executor.debug_adapter.process", description=__doc__)
    parser.add_argument("--channel-fd", type=int, required=True)
    options = parser.parse_args(arguments)
    die_with_parent()
    sys.stderr = Path(os.devnull).open("w")  # noqa: SIM115 - as debugpy's own program does with a pipe
    channel: Channel[FromAdapter, ToAdapter] = Channel(options.channel_fd, decode_to_adapter)
    try:
        _serve(channel)
    except (ChannelError, OSError):
        os._exit(1)  # the manager or the adapter is gone
    os._exit(0)


if __name__ == "__main__":
    main()
