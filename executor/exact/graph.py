"""The graph of an application whose world is in the same process."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from executor.headless.participants import Participants
    from executor.world.interface import World
    from tree_gardener.ros_node import ActionNode

__all__ = ["ExactGraph"]


class ExactGraph:
    """The node of an application, and the world's time. Nothing waits in it but the process itself."""

    domain_id = 0

    def __init__(self) -> None:
        self._woken = threading.Event()
        self._world: World | None = None
        self._ros: Participants | None = None

    def join(self, world: World, ros: Participants) -> None:
        """Takes the time of a world, and the node beside it."""
        self._world, self._ros = world, ros

    @property
    def node(self) -> ActionNode:
        """The node of the actions, once the world is there."""
        if self._ros is None:
            raise RuntimeError("the world is not built yet")
        return self._ros.application

    def now(self) -> float:
        """Returns the simulated time in s."""
        return self._world.time_s if self._world is not None else 0.0

    def sleep(self, duration_s: float) -> None:
        """Does nothing: simulated time does not pass within a tick."""

    def spin_once(self, timeout_s: float) -> None:
        """Waits until `wake`, at most for a time in s."""
        self._woken.wait(timeout_s)
        self._woken.clear()

    def wake(self) -> None:
        """Interrupts a wait of `spin_once`; thread-safe."""
        self._woken.set()

    def renew(self) -> None:
        """Waits by itself in a copy of the process: a thread that it does not have may hold the lock."""
        self._woken = threading.Event()

    def is_connected(self) -> bool:
        """Returns True: topics within a process are connected when they exist."""
        return True

    def close(self) -> None:
        """Does nothing: the process ends, and with it all that it has."""
