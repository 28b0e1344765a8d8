"""Shared memory of killed processes."""

from __future__ import annotations

import fcntl
import os

from executor.supervision.shared_memory import remove_abandoned_segments


def segment(folder, name, age_s):
    for file in (folder / name, folder / f"{name}_el"):
        file.write_bytes(b"")
        os.utime(file, (0, file.stat().st_mtime - age_s))


def test_segments_without_an_owner_are_removed(tmp_path):
    segment(tmp_path, "fastrtps_dead", 60)
    segment(tmp_path, "fastrtps_alive", 60)
    segment(tmp_path, "fastrtps_young", 0)
    segment(tmp_path, "other", 60)
    with (tmp_path / "fastrtps_alive_el").open() as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert remove_abandoned_segments(tmp_path) == 1
    left = {p.name for p in tmp_path.iterdir()}
    assert left == {f"{n}{s}" for n in ("fastrtps_alive", "fastrtps_young", "other") for s in ("", "_el")}
