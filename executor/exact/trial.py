"""One continuation of an exact run, in a copy of its process: what it does, and how it ends."""

from __future__ import annotations

import time
from hashlib import blake2b
from typing import TYPE_CHECKING, Any, Final

from executor import child_messages
from executor.child_messages import TryOutcome
from executor.replay_messages import FINGERPRINT_BYTES
from executor.trying_events import PATH_POINTS, Crash

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.exact.loop import ExactLoop
    from executor.world.interface import World
    from tree_gardener import Tree

__all__ = ["Trial", "Witness", "end_of"]

TOLD_S: Final = 0.2
EPSILON_S: Final = 1e-6
MOST_NODES: Final = 12
MOST_ROBOTS: Final = 8
HELD: Final = "The debugger held it."


class Witness:
    """Takes what a continuation says, in place of the session."""

    def __init__(self) -> None:
        self.fault: child_messages.Fault | None = None
        self.finished: child_messages.Finished | None = None
        self.refusal = ""
        self.prints = bytearray()

    def send(self, message: Any) -> None:
        """Keeps what the outcome needs."""
        match message:
            case child_messages.Fault():
                self.fault = self.fault or message
            case child_messages.Finished():
                self.finished = message
            case child_messages.Answer(error=error) if error is not None:
                self.refusal = self.refusal or f"{error.message} {error.hint}".strip()
            case child_messages.Fingerprints(data=data):
                self.prints += data
            case _:
                pass

    def flush(self, timeout_s: float) -> bool:
        """Returns True: nothing waits."""
        return True


class Trial:
    """Continues one run for a time, as fast as the machine can.

    Args:
        world: its world.
        loop: the loop of the world.
        tree: returns the tree.
        witness: takes what it says.
        tell: is called now and then with how far it is, 0 to 1.
    """

    def __init__(
        self,
        world: World,
        loop: ExactLoop,
        tree: Callable[[], Tree],
        witness: Witness,
        tell: Callable[[float], None],
    ) -> None:
        self._world = world
        self._loop = loop
        self._tree = tree
        self._witness = witness
        self._tell = tell
        self._robots = list(world.robots)[:MOST_ROBOTS]
        self._begin_s = loop.time_s
        self._begin_ticks = loop.ticks
        self._begin_m = self._robots[0].distance_m if self._robots else 0.0
        self._paths: dict[str, list[tuple[float, float, float]]] = {robot.id: [] for robot in self._robots}
        self._point_s = 0.0
        self._is_over = False
        self._collisions = 0
        self._crash: Crash | None = None
        self._told_s = time.monotonic()
        world.take_collisions()  # those before the moment

    def run(self, duration_s: float) -> None:
        """Makes ticks until the time is over; ends earlier by an exception where the run does."""
        self._point_s = duration_s / PATH_POINTS
        end_s = self._begin_s + duration_s - EPSILON_S
        self._look()
        while self._loop.time_s < end_s:
            self._loop.run_to_tick(lambda: None)
            self._look()
            now_s = time.monotonic()
            if now_s - self._told_s >= TOLD_S:
                self._told_s = now_s
                self._tell((self._loop.time_s - self._begin_s) / duration_s)
        self._is_over = True

    def outcome(self, job: str, index: int, known: bytes) -> TryOutcome:
        """Returns what happened.

        Args:
            job: the job to which it belongs.
            index: its number in the job.
            known: the fingerprints of what followed the moment in the recorded run.
        """
        self._look(is_last=True)
        witness, loop = self._witness, self._loop
        tree = self._tree()
        end, message = end_of(witness, is_over=self._is_over)
        prints = bytes(witness.prints)
        common = min(len(prints), len(known))
        first = self._robots[0].distance_m if self._robots else 0.0
        leaves = [node.path for node in tree.nodes if not node.children and node.status.name == "RUNNING"]
        return TryOutcome(
            job,
            index,
            end,
            message,
            t=loop.time_s,
            ticks=loop.ticks - self._begin_ticks,
            root=witness.finished.status if witness.finished is not None else tree.root.status.name,
            nodes=leaves[:MOST_NODES],
            distance_m=round(first - self._begin_m, 6),
            collisions=self._collisions,
            crash=self._crash,
            paths=self._paths,
            fingerprint=blake2b(prints, digest_size=FINGERPRINT_BYTES).hexdigest(),
            as_before=prints[:common] == known[:common] if common else None,
        )

    def _look(self, *, is_last: bool = False) -> None:
        """Takes the places of the robots, and what they hit."""
        now_s = self._loop.time_s
        places = {robot.id: robot.pose for robot in self._robots}
        for robot, (x, y, _) in places.items():
            path = self._paths[robot]
            if (
                not path
                or now_s - path[-1][0] >= self._point_s - EPSILON_S
                or (is_last and path[-1][0] < now_s)
            ):
                path.append((round(now_s, 4), round(x, 4), round(y, 4)))
        for name, collision in self._world.take_collisions():
            if collision.is_hit:
                continue
            self._collisions += 1
            if self._crash is None:
                x, y, _ = places.get(name, (0.0, 0.0, 0.0))
                self._crash = Crash(collision.time_s, x, y, collision.body, name)


def end_of(witness: Witness, *, is_over: bool) -> tuple[Any, str]:
    """Returns how a continuation ended, and why."""
    if witness.refusal:
        return "refused", witness.refusal
    if witness.fault is not None:
        fault = witness.fault
        at = f"{fault.file}:{fault.line}: " if fault.file else ""
        where = f"{fault.node_path}: " if fault.node_path else ""
        return "fault", f"{at}{where}{fault.message}"
    if witness.finished is not None:
        return "finished", witness.finished.message or f"The tree ended with {witness.finished.status}."
    return ("running", "") if is_over else ("held", HELD)
