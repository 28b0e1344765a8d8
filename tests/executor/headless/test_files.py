"""The files of a project are written where a run finds them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.headless.files import write_files

if TYPE_CHECKING:
    from pathlib import Path


def test_files_lie_at_their_paths(tmp_path: Path) -> None:
    write_files(tmp_path, {"a.xml": b"1", "actions/deep/Go.py": b"2"})
    assert (tmp_path / "actions" / "deep" / "Go.py").read_bytes() == b"2"


@pytest.mark.parametrize("name", ["../out", "/etc/out", "a/../../out"])
def test_a_path_that_leads_out_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ValueError, match="lies outside the project"):
        write_files(tmp_path / "in", {name: b""})
    assert not (tmp_path / "out").exists()
