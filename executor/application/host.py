"""Processes that run users' code: what prepares each, and what serves one of a session."""

from __future__ import annotations

import faulthandler
import os
import signal
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

from executor.application import compat
from executor.application.forks import limit_forks
from executor.ros.environment import ros_environment
from executor.supervision.channel import Channel, ChannelClosed, ChannelError
from executor.supervision.confine import die_with_parent
from executor.supervision.parking import PARKING
from executor.supervision.pulse import Pulse
from executor.supervision.threads import own

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Mapping

    from executor.application.process import Application
    from executor.child_messages import FromApplication, ToApplication

__all__ = ["enter", "prepare", "serve", "start_listener"]


def prepare() -> None:
    """Loads and installs the modules that actions expect. Call it after the ROS environment is set."""
    compat.warm_up()
    compat.install()


def enter(folder: Path) -> Callable[[], None]:
    """Makes the folder of the application the current folder, and its modules importable.

    Returns a function that undoes both. Modules of the project are searched last, after those of BT Studio
    and of Python.
    """
    before, paths = Path.cwd(), [str(folder), str(folder / "actions")]
    os.chdir(folder)
    sys.path += paths
    limit_forks()

    def leave() -> None:
        os.chdir(before)
        for path in paths:
            sys.path.remove(path)

    return leave


def serve(
    make: Callable[[Channel[Any, Any], Pulse], Application],
    decode: Callable[[bytes], Any],
    parser: argparse.ArgumentParser,
    arguments: list[str] | None = None,
    *,
    environment: Mapping[str, str] | None = None,
) -> None:
    """Runs an application for the manager at the other end of a channel; does not return.

    Args:
        make: makes the application on its channel.
        decode: decodes what the manager sends.
        parser: the parser of the command.
        arguments: the arguments of the command; None takes those of the process.
        environment: the environment of ROS, as far as it is not set.
    """
    parser.add_argument("--channel-fd", type=int, required=True)
    options = parser.parse_args(arguments)
    die_with_parent()
    faulthandler.enable()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the manager handles Ctrl-C
    for name, value in (environment or ros_environment(int(os.environ.get("ROS_DOMAIN_ID", "0")))).items():
        os.environ.setdefault(name, value)
    channel: Channel[Any, Any] = Channel(options.channel_fd, decode)
    pulse = Pulse(channel.send)

    prepare()
    application = make(channel, pulse)
    try:
        application.run()
        if os.getpid() == application.pid:
            application.close()
    except ChannelClosed:
        pass
    # Threads that actions started must not keep the process alive.
    os._exit(0)


def start_listener(
    channel: Channel[FromApplication, ToApplication], take: Callable[[ToApplication], object]
) -> None:
    """Starts a thread that receives messages, since the main thread waits for ROS.

    It ends the process with the channel: without a manager a run has no purpose.

    Args:
        channel: from the manager.
        take: is called with each message, in the thread.
    """
    own(threading.Thread(target=_listen, args=(channel, take), name="listener", daemon=True)).start()


def _listen(
    channel: Channel[FromApplication, ToApplication], take: Callable[[ToApplication], object]
) -> None:
    spot = PARKING.spot()
    try:
        while True:
            channel.wait()
            with spot:
                while (message := channel.receive(0)) is not None:
                    take(message)
    except ChannelClosed:
        os._exit(0)
    except ChannelError as error:
        os.write(2, f"The manager sent a message that cannot be read: {error}\n".encode())
        os._exit(1)
