"""Sources that the tools give out; their rules are tested with those of localhost."""

from __future__ import annotations

from executor.tools.sources import read_source, source_roots


def test_without_a_library_there_are_the_other_folders(tmp_path):
    roots = source_roots(tmp_path, tmp_path / "none")
    assert set(roots) == {"python", "packages", "typeshed", "modules"}
    assert read_source(str(tmp_path / "a.py"), roots.values()) is None
