"""The engine's files that go into a package."""

from __future__ import annotations

from translator.package.engine import engine_files


def test_the_engine_goes_whole_without_its_conformance_suite() -> None:
    files = engine_files()
    assert {"tree_gardener/__init__.py", "tree_gardener/catalog.json", "tree_gardener/py.typed"} <= set(files)
    assert not [path for path in files if "conformance" in path or "__pycache__" in path]
