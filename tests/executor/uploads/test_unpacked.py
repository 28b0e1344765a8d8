"""Plain files of an upload are unpacked below its folder, and nothing else."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import pytest

from executor.uploads import unpacked
from executor.uploads.unpacked import UploadError, unpack
from tests.executor.uploads.zips import zipped

if TYPE_CHECKING:
    from pathlib import Path


def test_links_tools_and_archives_inside_are_left_out(tmp_path: Path) -> None:
    files = {"a/b.urdf": b"x", "a/.git/config": b"x", "__MACOSX/b": b"x", "a/more.zip": zipped({"c": b"x"})}
    notes = unpack(io.BytesIO(zipped(files, {"a/out.stl": "/etc/passwd"})), "a.zip", tmp_path)
    assert [path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()] == [
        "a/b.urdf"
    ]
    assert sorted(path for path, _ in notes) == ["a/more.zip", "a/out.stl"]


def test_a_single_file_gets_its_plain_name(tmp_path: Path) -> None:
    assert unpack(io.BytesIO(b"<robot/>"), "../x/a\tb.urdf", tmp_path) == []
    assert [path.name for path in tmp_path.iterdir()] == ["ab.urdf"]


@pytest.mark.parametrize(
    ("data", "name", "code", "text"),
    [
        (b"no zip", "a.zip", "bad_archive", "not a zip"),
        (zipped({"a": b"x"})[:-30], "a.zip", "bad_archive", "not a zip"),
        (zipped({"../a": b"x"}), "a.zip", "bad_archive", "leads out"),
        (zipped({"/a": b"x"}), "a.zip", "bad_archive", "leads out"),
        (zipped({"a": b"x", "./a": b"y"}), "a.zip", "bad_archive", "twice"),
        (zipped({"a": b"x", "a/b": b"y"}), "a.zip", "bad_archive", "cannot|not a zip"),
        (zipped({"a" * 300: b"x"}), "a.zip", "bad_archive", "name too long"),
        (b"<robot/>", "..", "bad_archive", "no name"),
    ],
)
def test_what_cannot_be_unpacked_is_one_sentence(
    tmp_path: Path, data: bytes, name: str, code: str, text: str
) -> None:
    with pytest.raises(UploadError, match=text) as error:
        unpack(io.BytesIO(data), name, tmp_path)
    assert error.value.code == code


def test_more_than_the_most_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(unpacked, "MOST_BYTES", 1000)
    for data, name in ((zipped({"a": bytes(600), "b": bytes(600)}), "a.zip"), (bytes(1001), "a.urdf")):
        with pytest.raises(UploadError, match="holds more") as error:
            unpack(io.BytesIO(data), name, tmp_path)
        assert error.value.code == "quota_exceeded"
