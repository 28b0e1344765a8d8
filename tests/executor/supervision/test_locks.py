"""Files that their owner keeps locked while it lives."""

from __future__ import annotations

import fcntl
import os
import time
from typing import TYPE_CHECKING

from executor.supervision.locks import YOUNGEST_S, is_abandoned, is_young

if TYPE_CHECKING:
    from pathlib import Path


def test_a_file_is_abandoned_when_it_is_old_and_nobody_holds_it(tmp_path: Path) -> None:
    lock = tmp_path / "lock"
    lock.touch()
    assert is_young(lock)
    assert not is_abandoned(lock)
    old = time.time() - 2 * YOUNGEST_S
    os.utime(lock, (old, old))
    assert not is_young(lock)
    assert is_abandoned(lock)


def test_a_held_lock_is_not_abandoned(tmp_path: Path) -> None:
    lock = tmp_path / "lock"
    with lock.open("w") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        os.utime(lock, (0, 0))
        assert not is_abandoned(lock)
    assert is_abandoned(lock)


def test_a_file_that_is_gone_is_young_and_nobodys(tmp_path: Path) -> None:
    assert is_young(tmp_path / "no")
    assert not is_abandoned(tmp_path / "no")
