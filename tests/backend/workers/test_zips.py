"""Zips: equal bytes for equal files, and fast for large files."""

from __future__ import annotations

import io
import os
import zipfile

import pytest

from backend.core.processes.memory import MEBIBYTE, WORK_MIB
from backend.workers import zips
from backend.workers.pool import Limits, Pool
from translator.limits import FILE_BYTES, PROJECT_BYTES


def read(packed):
    with zipfile.ZipFile(io.BytesIO(packed)) as archive:
        return {entry.filename: (entry.compress_type, archive.read(entry)) for entry in archive.infolist()}


def test_the_same_files_give_the_same_bytes():
    files = {"b.txt": b"b" * 10, "a.bin": os.urandom(zips.LARGE + 1), "c.txt": b"c" * (zips.LARGE + 1)}
    assert zips.pack(files) == zips.pack(dict(reversed(files.items())))


@pytest.mark.parametrize(
    ("data", "kind"),
    [
        (b"small", zipfile.ZIP_DEFLATED),
        (b"text " * zips.LARGE, zipfile.ZIP_DEFLATED),
        (os.urandom(zips.LARGE), zipfile.ZIP_DEFLATED),
        (os.urandom(zips.LARGE + 1), zipfile.ZIP_STORED),
    ],
)
def test_what_does_not_shrink_is_stored(data, kind):
    assert read(zips.pack({"file": data})) == {"file": (kind, data)}


def test_the_largest_project_is_packed_within_the_memory_of_a_worker():
    """Also twice, while the worker still holds its last answer."""
    noise = os.urandom(FILE_BYTES)
    files = {f"assets/{n}.bin": noise for n in range(PROJECT_BYTES // FILE_BYTES)}
    pool = Pool(Limits(workers=1, per_owner=1, waiting=2, deadline_s=300, memory_bytes=WORK_MIB * MEBIBYTE))
    try:
        for name in ("one", "two"):
            packed = pool.ask("a", "pack", files=files | {"name": name.encode()}).result()["zip"]
            assert len(packed) > PROJECT_BYTES
    finally:
        pool.close()
