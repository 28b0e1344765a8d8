"""Defines the environment variables and the ports with which a process joins a session's ROS graph.

Set the variables before `rclpy` is imported.
"""

from __future__ import annotations

import contextlib
import os
import random
import socket
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

FASTDDS_PROFILE: Final = Path(__file__).with_name("fastdds.xml")
LOCKSTEP_PROFILE: Final = Path(__file__).with_name("lockstep.xml")
PARTICIPANTS: Final = 30
"""Number of participants of a host that are found without multicast, less some for the user's tools."""
SHARED_MEMORY: Final = Path("/dev/shm")  # noqa: S108 - Fast DDS has its ports there


def ros_environment(domain_id: int) -> dict[str, str]:
    """Returns the variables with which a process joins a session's graph on this host."""
    return {
        "ROS_DOMAIN_ID": str(domain_id),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
        "FASTDDS_DEFAULT_PROFILES_FILE": str(FASTDDS_PROFILE),
        "FASTRTPS_DEFAULT_PROFILES_FILE": str(FASTDDS_PROFILE),
        "RCUTILS_COLORIZED_OUTPUT": "0",
    }


def lockstep_environment() -> dict[str, str]:
    """Returns the variables of a process whose graph is isolated from all others."""
    profile = str(LOCKSTEP_PROFILE)
    # Otherwise the middleware adds transports of its own, among them shared memory.
    own = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SYSTEM_DEFAULT"}
    names = ("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE")
    return ros_environment(0) | own | dict.fromkeys(names, profile)


def use_lockstep_environment() -> None:
    """Sets the variables of `lockstep_environment` in this process, unless ROS was loaded before."""
    if "rclpy" not in sys.modules:
        os.environ.update(lockstep_environment())


@contextlib.contextmanager
def ports_of_its_own(domain_id: int) -> Iterator[None]:
    """Makes the participant that is created meanwhile take ports that none had shortly before.

    Fast DDS takes the first participant of a domain whose ports are free, so those of a process that has just
    ended. Others that wrote to that process continue to write to its shared memory, where nobody reads, for
    some seconds (eProsima/Fast-DDS, pull request 4737). So the ports before a random place are held here.
    """
    first = random.SystemRandom().randrange(PARTICIPANTS)
    with contextlib.ExitStack() as held:
        for participant in range(PARTICIPANTS):
            if participant < first or _was_left(domain_id, participant):
                _hold(discovery_port(domain_id, participant), held)
        yield


def discovery_port(domain_id: int, participant: int = 0) -> int:
    """Returns the port for unicast discovery of a participant, by the RTPS specification (section 9.6.1)."""
    return 7400 + 250 * domain_id + 10 + 2 * participant


def _was_left(domain_id: int, participant: int) -> bool:
    """Whether a participant's port for data is in use, or left by a process that was killed."""
    return (SHARED_MEMORY / f"fastrtps_port{discovery_port(domain_id, participant) + 1}").exists()


def _hold(port: int, held: contextlib.ExitStack) -> None:
    with contextlib.suppress(OSError):  # it is in use
        held.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)).bind(("127.0.0.1", port))


def has_tf() -> bool:
    """Returns whether `tf2_msgs` was built at set-up; without it `/tf` is left out."""
    return find_spec("tf2_msgs") is not None
