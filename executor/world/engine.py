"""PyBullet without its global state: one physics server, whose id is passed to every call."""

from __future__ import annotations

import functools
import os
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path


@contextmanager
def _silenced() -> Iterator[None]:
    """Suppresses the greeting that PyBullet prints in C at its import, since stdout may have to be JSON."""
    sys.stdout.flush()
    saved = [os.dup(1), os.dup(2)]
    null = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(null, 1)
        os.dup2(null, 2)
        yield
    finally:
        for target, copy in enumerate(saved, start=1):
            os.dup2(copy, target)
            os.close(copy)
        os.close(null)


with _silenced():
    import pybullet


PhysicsError: type[Exception] = pybullet.error
"""Is raised where the physics server refuses."""


class Bullet:
    """A physics server in this process. It has PyBullet's functions and constants."""

    def __init__(self) -> None:
        self._id: int = pybullet.connect(pybullet.DIRECT)
        if self._id < 0:
            raise RuntimeError("PyBullet gives no further physics server")

    def __getattr__(self, name: str) -> Any:
        value = getattr(pybullet, name)
        if callable(value):
            value = functools.partial(value, physicsClientId=self._id)
        self.__dict__[name] = value  # cached, since every step uses these functions
        return value

    def load_urdf(
        self, path: Path, pose: Sequence[float], *, is_fixed: bool = False, is_one_body: bool = False
    ) -> int:
        """Loads a file with the inertias that it states, and with round cylinders.

        One that stands fast and is one body costs a step less than one that could have joints.
        Bullet makes a polygon of a cylinder otherwise, on whose edges a wheel drives 2.8 % too far.
        """
        flags = pybullet.URDF_USE_INERTIA_FROM_FILE | pybullet.URDF_USE_IMPLICIT_CYLINDER
        uid: int = self.loadURDF(
            str(path),
            pose[:3],
            pose[3:],
            useFixedBase=is_fixed,
            useMaximalCoordinates=is_fixed and is_one_body,
            flags=flags,
        )
        return uid

    def close(self) -> None:
        """Ends the server. May be called twice."""
        if self._id >= 0:
            pybullet.disconnect(physicsClientId=self._id)
            self._id = -1
