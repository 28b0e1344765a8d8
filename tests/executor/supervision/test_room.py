"""Memory of a process, and of the container."""

from __future__ import annotations

import mmap
import os
from typing import TYPE_CHECKING

from executor.supervision.room import memory_room, private_bytes, processors

if TYPE_CHECKING:
    from pathlib import Path


def test_private_memory_grows_by_what_is_written() -> None:
    before = private_bytes(os.getpid())
    with mmap.mmap(-1, 32 << 20) as memory:
        memory.write(b"x" * (32 << 20))
        assert private_bytes(os.getpid()) >= before + (24 << 20)
    assert private_bytes(2**22 + 1) == 0


def test_the_room_is_a_share_of_the_limit_less_what_is_used(tmp_path: Path) -> None:
    assert memory_room(tmp_path) is None
    (tmp_path / "memory.current").write_text("700\n")
    (tmp_path / "memory.stat").write_text("anon 500\ninactive_file 100\n")
    (tmp_path / "memory.max").write_text("max\n")
    assert memory_room(tmp_path) is None
    (tmp_path / "memory.max").write_text("1000\n")
    assert memory_room(tmp_path) == 0
    (tmp_path / "memory.current").write_text("800\n")
    assert memory_room(tmp_path) == -100


def test_a_container_has_the_processors_of_its_quota(tmp_path: Path) -> None:
    quota = tmp_path / "cpu.max"
    there = len(os.sched_getaffinity(0))
    assert processors(quota) == there
    quota.write_text("max 100000\n")
    assert processors(quota) == there
    quota.write_text("100000 100000\n")
    assert processors(quota) == 1
    quota.write_text("5000 100000\n")
    assert processors(quota) == 1
