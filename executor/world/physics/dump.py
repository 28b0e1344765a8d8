"""The full state of a world as plain data, for another process.

Bullet writes its part in its own format, into a file in memory; the rest is MessagePack. Read it only from
recordings that were made here: Bullet trusts its format.

One thing is not restored exactly. Bullet keeps the contact points of two bodies in one cache for each pair of
their collision shapes, and `restoreState` finds the caches by the bodies alone. Where two bodies touch with
several pairs of shapes, points come into the cache of another pair, and one is there twice: once as it was,
once without the impulse with which the solver starts. Positions are still equal to the last bit after many
steps, and then begin to differ by some 1e-7 m. Bodies that touch with one pair of shapes are exact.
"""

from __future__ import annotations

import contextlib
import os
from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor.world.engine import PhysicsError
from executor.world.interface import WorldError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from executor.world.engine import Bullet

__all__ = ["DUMP_VERSION", "dump_state", "load_state", "restore_physics", "save_physics"]

DUMP_VERSION: Final = 1


class _State(msgspec.Struct):
    version: int
    universe: str
    steps: int
    placed: dict[str, list[float]]
    robots: dict[str, dict[str, Any]]
    actors: dict[str, list[float]]
    physics: bytes


_decode = msgspec.msgpack.Decoder(_State).decode


def dump_state(state: Mapping[str, Any]) -> bytes:
    """Returns the parts of a state as bytes."""
    return msgspec.msgpack.encode(state)


def load_state(data: bytes, universe: str, robots: Sequence[str], actors: Sequence[str]) -> dict[str, Any]:
    """Returns the parts of a state; it must be of this universe, with these robots and actors.

    Raises:
        WorldError: the data are not a state, or are that of another world.
    """
    try:
        state = _decode(data)
    except msgspec.DecodeError as error:
        raise WorldError(f"the state of the world cannot be read: {error}") from error
    if state.version > DUMP_VERSION:
        text = f"the state of the world has version {state.version}; this program reads up to {DUMP_VERSION}"
        raise WorldError(text)
    if (state.universe, [*state.robots], [*state.actors]) != (universe, list(robots), list(actors)):
        raise WorldError(f"the state is of the world {state.universe!r}, with other robots or people")
    return msgspec.structs.asdict(state)


def save_physics(bullet: Bullet) -> bytes:
    """Returns the state of the physics server in Bullet's own format."""
    with _memory_file() as (fd, path):
        bullet.saveBullet(path)
        return os.pread(fd, os.fstat(fd).st_size, 0)


def restore_physics(bullet: Bullet, data: bytes) -> None:
    """Restores a state of the physics server that holds the same bodies.

    Raises:
        WorldError: the data do not fit the bodies.
    """
    with _memory_file() as (fd, path):
        os.pwrite(fd, data, 0)
        try:
            bullet.restoreState(fileName=path)
        except PhysicsError as error:
            raise WorldError(f"the state of the world does not fit it: {error}") from error


@contextlib.contextmanager
def _memory_file() -> Iterator[tuple[int, str]]:
    fd = os.memfd_create("world")
    try:
        yield fd, f"/proc/self/fd/{fd}"
    finally:
        os.close(fd)
