"""Zips with the same bytes for the same files."""

from __future__ import annotations

import io
import zipfile

from translator.package.zip import write_zip


def test_the_order_of_files_does_not_matter() -> None:
    raw = write_zip({"b": b"2", "a/x": b"1"})
    assert raw == write_zip({"a/x": b"1", "b": b"2"})
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        assert archive.namelist() == ["a/x", "b"]
        assert archive.read("b") == b"2"
        assert archive.getinfo("b").external_attr >> 16 == 0o100644
