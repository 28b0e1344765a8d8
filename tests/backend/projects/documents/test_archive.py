"""Archives that are imported."""

from __future__ import annotations

import errno
import io
import zipfile

import pytest

from backend.core.scratch import scratch
from backend.projects.documents.archive import read_upload, unpack
from backend.projects.errors import ArchiveError
from backend.projects.storage.spools import Spool


def zipped(files: dict[str, str]) -> io.BytesIO:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    made.seek(0)
    return made


def contents(files):
    return {path: content.data for path, content in files.items()}


def test_a_folder_round_all_files_and_junk_are_left_out():
    with Spool() as spool:
        files = unpack(zipped({"robot/a": "1", "robot/b": "2", "__MACOSX/robot/._a": "junk"}), spool)
        assert contents(files) == {"a": b"1", "b": b"2"}


def test_what_is_no_zip_is_refused():
    with pytest.raises(ArchiveError):
        read_upload(io.BytesIO(b"nonsense"), "x.zip")
    assert scratch().used == 0


def test_an_upload_is_a_zip_or_a_tree():
    made = read_upload(zipped({"a": "1"}), "x.zip")
    tree = read_upload(io.BytesIO(b"<root/>"), "t.xml")
    with made.spool, tree.spool:
        assert contents(made.files) == {"a": b"1"}
        assert list(contents(tree.files).values()) == [b"<root/>"]


def test_a_full_disk_is_not_the_fault_of_the_zip(monkeypatch):
    def write(*_):
        raise OSError(errno.ENOSPC, "no space left")

    with Spool() as spool:
        monkeypatch.setattr(scratch(), "take", write)
        with pytest.raises(OSError, match="no space left"):
            unpack(zipped({"a": "1"}), spool)


@pytest.mark.parametrize(
    ("filename", "path"),
    [("Night patrol.XML", "Night patrol.xml"), ("a/b.btproj", "b.btproj"), ("con.xml", "import.xml")],
)
def test_a_single_file_keeps_its_name_if_a_project_may_have_it(filename, path):
    upload = read_upload(io.BytesIO(b"<root/>"), filename)
    with upload.spool:
        assert list(upload.files) == [path]
