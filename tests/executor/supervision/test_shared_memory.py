"""Shared memory of killed processes."""

from __future__ import annotations

import fcntl
import mmap
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


def test_ports_without_a_reader_or_a_mapping_are_removed(tmp_path):
    for number in (7410, 7412, 7414, 7416):
        for name in (f"fastrtps_port{number}", f"sem.fastrtps_port{number}_mutex"):
            (tmp_path / name).write_bytes(b"x")
            os.utime(tmp_path / name, (0, 0))
    (tmp_path / "fastrtps_port7412_sl").write_bytes(b"")  # its readers share it
    os.utime(tmp_path / "fastrtps_port7414")  # another process may be creating it
    with (tmp_path / "fastrtps_port7416").open() as port, mmap.mmap(port.fileno(), 0, prot=mmap.PROT_READ):
        assert remove_abandoned_segments(tmp_path) == 1
    assert not list(tmp_path.glob("*7410*"))
    assert {p.name for p in tmp_path.glob("fastrtps_port*")} == {
        *("fastrtps_port7412", "fastrtps_port7412_sl", "fastrtps_port7414", "fastrtps_port7416")
    }
    assert remove_abandoned_segments(tmp_path) == 1  # the one that was mapped
