"""Two pools of processes, so that small jobs do not wait behind large jobs of any user.

The answer to a save includes a check of the project, which takes milliseconds. Large jobs run at a lower
priority (*nice*), so that requests are answered first. Small jobs run at normal priority, since editors wait
for them.
"""

from __future__ import annotations

import os
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from backend.config.environment import environment
from backend.core.processes.memory import MEBIBYTE, limit_mib
from backend.core.processes.siblings import POOL, siblings
from backend.workers.pool import Limits, Pool, packed_job
from backend.workers.remote import RemotePool

if TYPE_CHECKING:
    from concurrent.futures import Future

PER_OWNER: Final = 1
"""Number of jobs of one owner that may be in progress in each of the two pools."""
NICENESS: Final = 10
"""The niceness of processes for large work, so that requests and small work have priority."""
TOO_LONG_KEPT_S: Final = 60.0
"""Seconds for which a large job that took too long is refused again.

Small jobs may be repeated immediately.
"""
SMALL_WAITING: Final = 16
LARGE_WAITING: Final = 4
"""Number of large jobs that may wait for each process.

Small jobs take milliseconds, so many of them may wait.
"""
SMALL_BYTES: Final = 256 << 10
"""The largest arguments of a small job, in bytes; a project of some hundred nodes takes about 50 KB."""


class Pools:
    """Gives each job to one of two pools, by the size of its arguments.

    Args:
        small: the pool for small work.
        large: the pool for all other work.
    """

    def __init__(self, small: Pool, large: Pool) -> None:
        self._small, self._large = small, large

    @property
    def waiting(self) -> int:
        """The number of jobs that wait for a worker."""
        return self._small.waiting + self._large.waiting

    def close(self) -> None:
        """Ends all workers, like `Pool.close`."""
        self._small.close()
        self._large.close()

    def ask(self, owner: str, job: str, **arguments: Any) -> Future[Any]:
        """Hands a job to a pool, like `Pool.ask`.

        Raises:
            BusyError: too many jobs wait.
        """
        packed = packed_job(job, arguments)
        lane = self._small if len(packed) <= SMALL_BYTES else self._large
        return lane.ask_packed(owner, packed)


@lru_cache(maxsize=1)
def pool() -> Pools | RemotePool:
    """Returns the pools of this web server, which its workers share."""
    family = siblings.family
    return make_pools() if family is None else RemotePool(family.folder / POOL)


def make_pools() -> Pools:
    """Makes the pools with the limits of this server."""
    processes = environment().processes(os.cpu_count() or 1, limit_mib())
    memory_bytes = processes.each_mib * MEBIBYTE
    small = _pool(processes.small, SMALL_WAITING, memory_bytes)
    large = _pool(
        processes.large, LARGE_WAITING, memory_bytes, niceness=NICENESS, too_long_kept_s=TOO_LONG_KEPT_S
    )
    return Pools(small, large)


def _pool(
    workers: int, waiting: int, memory_bytes: int, *, niceness: int = 0, too_long_kept_s: float = 0.0
) -> Pool:
    return Pool(
        Limits(
            workers=workers,
            per_owner=PER_OWNER,
            waiting=waiting * workers,
            deadline_s=environment().work_deadline_s,
            memory_bytes=memory_bytes,
            niceness=niceness,
            too_long_kept_s=too_long_kept_s,
        )
    )
