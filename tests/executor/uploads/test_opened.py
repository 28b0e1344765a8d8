"""A file, a folder or a zip of the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.uploads.opened import chosen, opened
from executor.uploads.unpacked import UploadError
from tests.executor.uploads.zips import WORLD, zipped

if TYPE_CHECKING:
    from pathlib import Path


def test_a_zip_is_a_folder_for_as_long_as_it_is_open(tmp_path: Path) -> None:
    source = tmp_path / "shop.zip"
    source.write_bytes(zipped(WORLD, {"shop/out": "/etc"}))
    with opened(source) as (root, notes):
        file = chosen(root, "universe", "")
        assert file.relative_to(root).as_posix() == "shop/worlds/yard.sdf"
        assert chosen(root, "robot", "").parent.name == "crate"
        assert [path for path, _ in notes] == ["shop/out"]
    assert not root.exists()
    with opened(tmp_path) as (root, notes):
        assert (root, notes) == (tmp_path, [])


def test_the_file_of_a_folder_is_the_one_that_no_other_includes(tmp_path: Path) -> None:
    for kind, text in (("robot", "there is no URDF"), ("universe", "there is no SDF world or map")):
        with pytest.raises(UploadError, match=text):
            chosen(tmp_path, kind, "")
    (tmp_path / "base.urdf").write_text('<robot name="a"/>')
    assert chosen(tmp_path, "robot", "").name == "base.urdf"
    (tmp_path / "top.xacro").write_text('<robot name="b"><include filename="base.urdf"/></robot>')
    assert chosen(tmp_path, "robot", "").name == "top.xacro"
    (tmp_path / "other.urdf").write_text('<robot name="c"/>')
    with pytest.raises(UploadError, match=r"by --main: other\.urdf, top\.xacro"):
        chosen(tmp_path, "robot", "")
    assert chosen(tmp_path, "robot", "other.urdf") == tmp_path / "other.urdf"
    assert chosen(tmp_path / "other.urdf", "robot", "") == tmp_path / "other.urdf"
    (tmp_path / "folder").mkdir()
    for main in ("none.urdf", "../x.urdf", "folder"):
        with pytest.raises(UploadError, match="there is no file"):
            chosen(tmp_path, "robot", main)
    with pytest.raises(UploadError, match="there is no file"):
        chosen(tmp_path / "folder", "robot", str(tmp_path / "base.urdf"))
