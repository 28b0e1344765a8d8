"""Archives that are imported."""

from __future__ import annotations

import io
import zipfile

import pytest

from backend.projects.documents.archive import read_upload, unpack
from backend.projects.errors import ArchiveError


def zipped(files: dict[str, str]) -> io.BytesIO:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    made.seek(0)
    return made


def test_a_folder_round_all_files_and_junk_are_left_out():
    files = unpack(zipped({"robot/a": "1", "robot/b": "2", "__MACOSX/robot/._a": "junk"}))
    assert files == {"a": b"1", "b": b"2"}


def test_what_is_no_zip_is_refused():
    with pytest.raises(ArchiveError):
        unpack(io.BytesIO(b"nonsense"))


def test_an_upload_is_a_zip_or_a_tree():
    assert read_upload(zipped({"a": "1"}), "x.zip").files == {"a": b"1"}
    tree = read_upload(io.BytesIO(b"<root/>"), "t.xml")
    assert list(tree.files.values()) == [b"<root/>"]


@pytest.mark.parametrize(
    ("filename", "path"),
    [("Night patrol.XML", "Night patrol.xml"), ("a/b.btproj", "b.btproj"), ("con.xml", "import.xml")],
)
def test_a_single_file_keeps_its_name_if_a_project_may_have_it(filename, path):
    upload = read_upload(io.BytesIO(b"<root/>"), filename)
    assert list(upload.files) == [path]
