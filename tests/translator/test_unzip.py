"""Zips are opened in one place, which bounds their directories before it makes an object of each entry."""

from __future__ import annotations

import ast
import io
import struct
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from translator.unzip import DAMAGED, PROJECT, ArchiveTooLargeError, Limits, chunks, open_zip

ROOT = Path(__file__).parents[2]
END = struct.Struct("<4s4H2LH")
END64 = struct.Struct("<4sQ2H2L4Q")
LOCATOR = struct.Struct("<4sLQL")
NAMES = 3_000_000
MEMORY = 400 << 20


def zipped(*entries, method=zipfile.ZIP_DEFLATED):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", method) as made:
        for name, content in entries:
            made.writestr(name, content)
    return data.getvalue()


def forged(directory, tail):
    """A zip of this directory; the plain end record says nothing of it."""
    return directory + tail(len(directory))


def plain(size):
    return END.pack(b"PK\5\6", 0, 0, 1, 1, size, 0, 0)


def only_in_zip64(size):
    record = END64.pack(b"PK\6\6", 44, 45, 45, 0, 0, 1, 1, size, 0)
    return record + LOCATOR.pack(b"PK\6\7", 0, size, 1) + END.pack(b"PK\5\6", 0, 0, 1, 1, 0, 0, 0)


def with_a_second_signature(size):
    """Inside of the end record begins another one, which a search from the end finds first."""
    return struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 1, 1, size, int.from_bytes(b"PK\5\6", "little"), 0)


def one_entry():
    raw = zipped(("a", ""))
    return raw[raw.index(b"PK\1\2") : raw.index(b"PK\5\6")]


@pytest.mark.parametrize("tail", [plain, only_in_zip64, with_a_second_signature])
def test_a_directory_of_many_bytes_is_refused_however_it_is_declared(tail):
    raw = forged(b"\0" * (PROJECT.directory_bytes + 1), tail)
    with pytest.raises((ArchiveTooLargeError, zipfile.BadZipFile)) as caught:
        open_zip(io.BytesIO(raw))
    if tail is not with_a_second_signature:  # its directory begins before the file
        assert "directory is larger than 4 MB" in str(caught.value)


@pytest.mark.parametrize("tail", [plain, only_in_zip64])
def test_entries_are_counted_before_objects_are_made_of_them(tail):
    raw = forged(one_entry() * 11, tail)
    assert len(open_zip(io.BytesIO(raw), Limits(PROJECT.directory_bytes, 11)).infolist()) == 11
    with pytest.raises(ArchiveTooLargeError, match="more than 10 entries"):
        open_zip(io.BytesIO(raw), Limits(PROJECT.directory_bytes, 10))


def test_an_archive_of_three_million_names_takes_no_memory():
    program = f"""
import io, sys, tracemalloc
from tests.translator.test_unzip import forged, one_entry, only_in_zip64
from translator.unzip import ArchiveTooLargeError, open_zip
data = io.BytesIO(forged(one_entry() * {NAMES}, only_in_zip64))
tracemalloc.start()
try:
    open_zip(data)
except ArchiveTooLargeError as error:
    print(error)
print(tracemalloc.get_traced_memory()[1])
"""
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, cwd=ROOT
    )
    says, peak = done.stdout.splitlines()
    assert says == "its directory is larger than 4 MB"
    assert int(peak) < MEMORY


def test_entries_are_read_up_to_a_limit_whatever_their_headers_say():
    raw = zipped(("a", b"x" * 3_000_000))
    raw = raw.replace((3_000_000).to_bytes(4, "little"), (3_500_000).to_bytes(4, "little"))
    with open_zip(io.BytesIO(raw)) as archive:
        entry = archive.getinfo("a")
        with pytest.raises(ArchiveTooLargeError, match="more than 2999999 bytes"):
            list(chunks(archive, entry, 2_999_999))
        assert max(map(len, chunks(archive, entry, 3_000_000))) <= 256 * 1024


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_a_compression_that_unpacks_without_a_bound_is_refused(method):
    raw = zipped(("bomb", bytes(50_000_000)), method=method)
    assert len(raw) < 10_000
    with pytest.raises(DAMAGED, match="compression other than deflate"):
        open_zip(io.BytesIO(raw))


@pytest.mark.parametrize("raw", [b"", b"junk", zipped(("a", "b"))[:30]], ids=["empty", "junk", "half"])
def test_what_is_no_zip_is_damaged(raw):
    with pytest.raises(DAMAGED):
        open_zip(io.BytesIO(raw))


def reading_calls(path):
    """The lines in which a module opens a zip by itself, other than to write it."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.Call) or not ast.unparse(node.func).endswith(
            ("ZipFile", "unpack_archive")
        ):
            continue
        modes = [argument for argument in node.args[1:2] if isinstance(argument, ast.Constant)]
        if not modes or modes[0].value != "w":
            yield f"{path.relative_to(ROOT)}:{node.lineno}"


def test_no_other_module_opens_zips_for_reading():
    found = [
        place
        for package in ("backend", "executor", "translator", "tree_gardener")
        for path in (ROOT / package).rglob("*.py")
        for place in reading_calls(path)
    ]
    assert [place.partition(":")[0] for place in found] == ["translator/unzip.py"]
