"""Fingerprints of the ticks of an exact run: two runs that have the same ones did the same."""

from __future__ import annotations

import struct
from hashlib import blake2b
from typing import TYPE_CHECKING, Any, Final

from executor.replay_messages import FINGERPRINT_BYTES

if TYPE_CHECKING:
    from executor.world.interface import World
    from tree_gardener import TickChanges, Tree

__all__ = ["Fingerprints"]

_PLAIN: Final[tuple[Any, ...]] = (bool, int, float, str, bytes, type(None))
_BITS: Final = 4_096


class Fingerprints:
    """Computes the fingerprint of each tick: time, poses, statuses, and what was written.

    A value of the blackboard without a plain form counts by its type.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._changes: list[TickChanges] = []

    def follow(self, tree: Tree) -> None:
        """Observes a tree."""
        tree.observe(self._changes.append)

    def take(self) -> bytes:
        """Returns the fingerprint of what happened since the last call."""
        changes, self._changes[:] = list(self._changes), []
        digest = blake2b(struct.pack("<d", self._world.time_s), digest_size=FINGERPRINT_BYTES)
        digest.update(self._world.read_poses()().tobytes())
        for robot in self._world.robots:
            digest.update(struct.pack("<3d", *robot.pose))
        for change in changes:
            digest.update(repr(_plain(change)).encode())
        return digest.digest()


def _plain(change: TickChanges) -> Any:
    # Changes have no order that means anything: it depends on when an observer, as a recording, begins.
    changed = sorted((uid, status.name) for uid, status in change.changed)
    flashed = [(uid, status.name) for uid, status in change.flashed]
    written = sorted(
        (entry.scope, entry.key, _value(entry.value) or entry.type, entry.removed)
        for entry in change.blackboard
    )
    return change.tick, changed, flashed, written


def _value(value: Any) -> str:
    for kind in _PLAIN:
        if issubclass(type(value), kind):
            is_long = kind is int and int.bit_length(value) > _BITS  # Python refuses to write it in decimals
            return int.__format__(value, "x") if is_long else str(kind.__repr__(value))
    return ""
