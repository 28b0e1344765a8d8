"""Untrusted archives, hostile in every known way."""

from __future__ import annotations

import base64
import contextlib
import io
import random
import stat
import struct
import zipfile

import pytest

from executor.manager import archive
from executor.manager.archive import ArchiveError, unpack
from translator.limits import ARCHIVE_DIRECTORY_BYTES


def packed(*entries):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in entries:
            file.writestr(name, content)
    return base64.b64encode(data.getvalue()).decode()


def test_files_and_folders_are_unpacked(tmp_path):
    unpack(packed(("a.txt", "A"), ("d/", ""), ("d/e/ü.py", "B")), tmp_path)
    assert (tmp_path / "a.txt").read_text() == "A"
    assert (tmp_path / "d/e/ü.py").read_text() == "B"


@pytest.mark.parametrize(
    "name", ["../up", "a/../../up", "/etc/x", "a\\..\\b", "C:evil", "..", "x" * 300, "d/./../../x"]
)
def test_no_name_leads_out_of_the_folder(tmp_path, name):
    folder = tmp_path / "in"
    folder.mkdir()
    with pytest.raises(ArchiveError):
        unpack(packed((name, "x")), folder)
    assert [p.name for p in tmp_path.iterdir()] == ["in"]


@pytest.mark.parametrize("kind", [stat.S_IFLNK, stat.S_IFIFO, stat.S_IFCHR])
def test_links_and_devices_are_refused(tmp_path, kind):
    entry = zipfile.ZipInfo("link")
    entry.external_attr = (kind | 0o777) << 16
    with pytest.raises(ArchiveError, match="neither a file"):
        unpack(packed((entry, "/etc/passwd")), tmp_path)


def test_a_zip_bomb_is_stopped_by_its_unpacked_size(tmp_path, monkeypatch):
    monkeypatch.setattr(archive, "MAX_FILE_BYTES", 1000)
    with pytest.raises(ArchiveError, match="too large"):
        unpack(packed(("bomb", b"0" * 10_000_000)), tmp_path)
    monkeypatch.setattr(archive, "MAX_TOTAL_BYTES", 1500)
    with pytest.raises(ArchiveError, match="too large"):
        unpack(packed(*((f"f{n}", b"0" * 900) for n in range(3))), tmp_path)


def test_too_many_files_and_files_twice_are_refused(tmp_path, monkeypatch):
    with pytest.raises(ArchiveError, match="twice"):
        unpack(packed(("a", "1"), ("A", "2")), tmp_path)
    monkeypatch.setattr(archive, "MAX_FILES", 3)
    with pytest.raises(ArchiveError, match="more than 3"):
        unpack(packed(*((str(n), "") for n in range(4))), tmp_path)


def test_a_file_under_a_file_is_refused(tmp_path):
    with pytest.raises(ArchiveError):
        unpack(packed(("a", "1"), ("a/b", "2")), tmp_path)


def test_a_damaged_zip_is_refused(tmp_path):
    whole = base64.b64decode(packed(("a", "hello" * 100)))
    for cut in (0, 10, len(whole) // 2, len(whole) - 3):
        with pytest.raises(ArchiveError):
            unpack(base64.b64encode(whole[:cut]).decode(), tmp_path)
    broken = bytearray(whole)
    broken[40] ^= 0xFF
    with pytest.raises(ArchiveError):
        unpack(base64.b64encode(bytes(broken)).decode(), tmp_path)


def test_an_encrypted_entry_is_refused(tmp_path):
    whole = bytearray(base64.b64decode(packed(("a", "x"))))
    at = whole.rfind(b"PK\x01\x02") + 8
    struct.pack_into("<H", whole, at, 1)
    with pytest.raises(ArchiveError):
        unpack(base64.b64encode(bytes(whole)).decode(), tmp_path)


def test_what_is_not_base64_is_refused(tmp_path):
    with pytest.raises(ArchiveError, match="base64"):
        unpack("no base64!", tmp_path)


def test_a_directory_of_millions_is_refused_before_it_is_read(tmp_path):
    whole = base64.b64decode(packed(("a", "x")))
    start, end = whole.rfind(b"PK\1\2"), whole.rfind(b"PK\5\6")
    size = ARCHIVE_DIRECTORY_BYTES + 1
    large, tail = whole[:start] + bytes(size), bytearray(whole[end:])
    struct.pack_into("<L", tail, 12, size)
    with pytest.raises(ArchiveError, match="directory is larger"):
        unpack(base64.b64encode(large + tail).decode(), tmp_path)
    struct.pack_into("<L", tail, 12, 0xFFFFFFFF)
    with pytest.raises(ArchiveError):
        unpack(base64.b64encode(large + tail).decode(), tmp_path)


def test_overlapping_entries_count_by_their_unpacked_size(tmp_path, monkeypatch):
    """In such a bomb all entries of the directory refer to the same data."""
    monkeypatch.setattr(archive, "MAX_TOTAL_BYTES", 50_000)
    whole = base64.b64decode(packed(("aaaa", b"0" * 20_000)))
    start, end = whole.rfind(b"PK\1\2"), whole.rfind(b"PK\5\6")
    entry, tail = whole[start:end], bytearray(whole[end:])
    names = [f"{n:04}".encode() for n in range(100)]
    directory = b"".join(entry.replace(b"aaaa", name) for name in names)
    struct.pack_into("<HHL", tail, 8, len(names), len(names), len(directory))
    with pytest.raises(ArchiveError):
        unpack(base64.b64encode(whole[:start] + directory + bytes(tail)).decode(), tmp_path)
    assert sum(p.stat().st_size for p in tmp_path.iterdir()) <= 50_000


def test_no_entry_keeps_the_right_to_be_run_as_another_user(tmp_path):
    entry = zipfile.ZipInfo("tool")
    entry.external_attr = (stat.S_IFREG | stat.S_ISUID | 0o777) << 16
    unpack(packed((entry, "x")), tmp_path)
    assert not (tmp_path / "tool").stat().st_mode & (stat.S_ISUID | 0o111)


def test_random_damage_never_breaks_out(tmp_path):
    whole = base64.b64decode(packed(("a/b.py", "x" * 200), ("c", b"y" * 50)))
    chance = random.Random(7)  # noqa: S311
    folder = tmp_path / "in"
    for n in range(300):
        broken = bytearray(whole)
        for _ in range(chance.randrange(1, 6)):
            broken[chance.randrange(len(broken))] = chance.randrange(256)
        target = folder / str(n)
        target.mkdir(parents=True)
        with contextlib.suppress(ArchiveError):
            unpack(base64.b64encode(bytes(broken)).decode(), target)
    assert [p.name for p in tmp_path.iterdir()] == ["in"]
