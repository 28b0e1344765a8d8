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


def test_the_room_is_known_in_version_1_of_control_groups_too(tmp_path: Path) -> None:
    memory = tmp_path / "memory"
    memory.mkdir()
    (memory / "memory.usage_in_bytes").write_text("700\n")
    (memory / "memory.stat").write_text("inactive_file 5\ntotal_inactive_file 100\n")
    (memory / "memory.limit_in_bytes").write_text("9223372036854771712\n")
    assert memory_room(tmp_path) is None
    (memory / "memory.limit_in_bytes").write_text("1000\n")
    assert memory_room(tmp_path) == 0


def test_a_container_has_the_processors_of_its_quota(tmp_path: Path) -> None:
    quota = tmp_path / "cpu.max"
    there = len(os.sched_getaffinity(0))
    assert processors(tmp_path) == there
    quota.write_text("max 100000\n")
    assert processors(tmp_path) == there
    quota.write_text("100000 100000\n")
    assert processors(tmp_path) == 1
    quota.write_text("5000 100000\n")
    assert processors(tmp_path) == 1


def test_the_quota_is_known_in_version_1_of_control_groups_too(tmp_path: Path) -> None:
    group = tmp_path / "cpu"
    group.mkdir()
    (group / "cpu.cfs_period_us").write_text("100000\n")
    (group / "cpu.cfs_quota_us").write_text("-1\n")
    assert processors(tmp_path) == len(os.sched_getaffinity(0))
    (group / "cpu.cfs_quota_us").write_text("150000\n")
    assert processors(tmp_path) == 1
