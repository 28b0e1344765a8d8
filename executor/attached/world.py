"""The world of an attached session: `python -m executor.attached.world --channel-fd N`.

The robot is elsewhere, so there is nothing to simulate: it tells that it is ready, and confirms each request.
"""

from __future__ import annotations

import argparse
import signal
from typing import Final

from executor import child_messages
from executor.child_messages import FromWorld, ToWorld, decode_to_world
from executor.messages import Error
from executor.supervision.channel import Channel, ChannelClosed
from executor.supervision.confine import die_with_parent
from executor.supervision.pulse import Pulse

__all__ = ["main"]

TURN_S: Final = 0.25
_CONFIRMED: Final = (child_messages.Pause, child_messages.Resume)


def answer(message: ToWorld) -> list[FromWorld]:
    """Returns the answers to a message of the session."""
    if isinstance(message, child_messages.StartWorld):
        return [child_messages.Starting(), child_messages.WorldReady()]
    if isinstance(message, _CONFIRMED):
        return [child_messages.Answer(request=message.request)]
    if isinstance(message, child_messages.Asked) and message.request is not None:
        error = Error("attached", "An attached session has no simulated world.")
        return [child_messages.Answer(request=message.request, error=error)]
    return []


def main(arguments: list[str] | None = None) -> None:
    """Answers the manager at the other end of a channel, until it ends."""
    parser = argparse.ArgumentParser(prog="python -m executor.attached.world", description=__doc__)
    parser.add_argument("--channel-fd", type=int, required=True)
    options = parser.parse_args(arguments)
    die_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the manager handles Ctrl-C
    channel: Channel[FromWorld, ToWorld] = Channel(options.channel_fd, decode_to_world)
    pulse = Pulse(channel.send)
    pulse.rests()
    try:
        while True:
            pulse.moved()
            message = channel.receive(TURN_S)
            if isinstance(message, child_messages.Stop):
                return
            for reply in answer(message) if message is not None else ():
                channel.send(reply)
    except ChannelClosed:
        return


if __name__ == "__main__":
    main()
