"""A project is opened from any set of files."""

from __future__ import annotations

import pytest

from translator import TranslatorError
from translator.opening import open_files, open_path

XML = '<root BTCPP_format="4"><BehaviorTree ID="Main"><AlwaysSuccess/></BehaviorTree></root>'


def test_a_folder_a_tree_and_a_diagram_are_opened(tmp_path) -> None:
    (tmp_path / "a.xml").write_text(XML)
    assert list(open_path(tmp_path / "a.xml").trees) == ["Main"]
    (tmp_path / "trees").mkdir()
    (tmp_path / "trees" / "T.json").write_text('{"id": "T", "root": null, "nodes": {}}')
    assert list(open_path(tmp_path / "trees" / "T.json").trees) == ["T"]
    (tmp_path / "a.xml").unlink()
    assert list(open_path(tmp_path).trees) == ["T"]


def test_files_without_a_tree_are_refused() -> None:
    with pytest.raises(TranslatorError):
        open_files({"README.md": b"hello"})
