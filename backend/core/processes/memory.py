"""The memory that one web server may take: the sum of what its parts may take, which limits follow.

A container gets at least this much (`docker/`, and a test that reads its files); how many processes a server
starts by itself follows from the limit of its container.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final, NamedTuple

MEBIBYTE: Final = 1 << 20
WORK_MIB: Final = 1024
"""What a process of the pool may take: the largest project is packed within it."""
PARENT_MIB: Final = 128
"""The parent of several workers, and the process that shares the pool among them."""
WORKER_MIB: Final = 256
"""A web worker: 75 to 150 MiB, and 64 MiB of contents of files."""
MESSAGE_MIB: Final = 68
"""The largest message of a socket, which a worker takes however small its part of all messages is."""
ANSWERS_MIB: Final = 64
"""Answers of the pool that are kept."""
FILES_MIB: Final = 256
"""Files below `/tmp`, which is memory where the root is read-only."""
SMALL_PROCESSES: Final = {"local": 1, "team": 2}
"""Number of processes for small work, by mode."""
CGROUPS: Final = (
    Path("/sys/fs/cgroup/memory.max"),
    Path("/sys/fs/cgroup/memory/memory.limit_in_bytes"),
)


class Processes(NamedTuple):
    """The processes of a web server.

    Attributes:
        workers: those that answer requests.
        small: those of the pool for small work.
        large: those of the pool for large work.
        each_mib: the memory that one of the pool may take.
        readers_mib: the memory of answers that are on their way to readers; messages may take as much.
    """

    workers: int
    small: int
    large: int
    each_mib: int
    readers_mib: int

    def needed_mib(self) -> int:
        """Returns the memory that they may take together."""
        parent = PARENT_MIB if self.workers > 1 else 0
        pool = (self.small + self.large) * self.each_mib
        messages = max(self.readers_mib, self.workers * MESSAGE_MIB)
        held = self.readers_mib + messages + ANSWERS_MIB + FILES_MIB
        return parent + self.workers * WORKER_MIB + held + pool


def fitting(  # noqa: PLR0913 - one a setting
    mode: str,
    cores: int,
    limit_mib: int | None,
    *,
    workers: int,
    large: int,
    each_mib: int,
    unread_bytes: int,
) -> Processes:
    """Returns the processes that a server starts.

    Args:
        mode: `local` or `team`.
        cores: the number of processors.
        limit_mib: the memory of its container; None if nothing limits it.
        workers: the configured number of workers; 0 chooses one less than there are processors.
        large: the configured number of processes for large work; 0 chooses one a processor, at least two.
        each_mib: the memory that one process of the pool may take.
        unread_bytes: the bytes of answers that may be on their way to readers, and of messages.
    """
    is_local = mode == "local"
    least = 1 if is_local else 2
    found = Processes(
        workers or (1 if is_local else max(1, cores - 1)),
        SMALL_PROCESSES[mode],
        large or (1 if is_local else max(least, cores)),
        each_mib,
        -(-unread_bytes // MEBIBYTE),
    )
    if limit_mib is None:
        return found
    # Workers go first: each answers requests, while large work of others waits.
    while not workers and found.workers > 1 and _over(found._replace(large=large or least), limit_mib):
        found = found._replace(workers=found.workers - 1)
    while not large and found.large > least and _over(found, limit_mib):
        found = found._replace(large=found.large - 1)
    return found


def _over(processes: Processes, limit_mib: int) -> bool:
    return processes.needed_mib() > limit_mib


def limit_mib(files: tuple[Path, ...] = CGROUPS) -> int | None:
    """Returns the memory that the container of this process may take; None if nothing limits it."""
    for file in files:
        try:
            text = file.read_text(encoding="ascii").strip()
        except OSError:
            continue
        # Without a limit version 2 says "max", and version 1 a number near 2**63.
        return int(text) // MEBIBYTE if text.isdecimal() and int(text) < 1 << 60 else None
    return None
