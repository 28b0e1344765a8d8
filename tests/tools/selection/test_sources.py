"""Modules are taken apart once for each text."""

from __future__ import annotations

import subprocess

from tests.tools.selection import sources
from tests.tools.selection.tree import working_tree


def test_a_text_that_was_seen_is_not_read_again(tmp_path, monkeypatch):
    monkeypatch.setattr(sources, "CACHE", tmp_path / "var" / "units.pickle")
    (tmp_path / "a.py").write_text("A = 1\n")
    (seen,) = working_tree(tmp_path).values()
    first = sources.modules({"a.py": seen}, ["a.py"], tmp_path)
    (tmp_path / "a.py").write_text("B = 1\n")
    assert sources.modules({"b.py": seen}, ["b.py"], tmp_path)["b.py"] == first["a.py"]
    assert sources.modules({"a.py": "changed"}, ["a.py"], tmp_path) != first
    assert sources.modules({"a.py": seen}, ["a.py"], tmp_path) == first
    sources.CACHE.write_bytes(b"half")
    assert [unit.name for unit in sources.modules({"a.py": seen}, ["a.py"], tmp_path)["a.py"].units] == ["B"]


def test_a_module_is_read_as_a_commit_has_it(tmp_path):
    def git(*arguments):
        name = ("-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false")
        subprocess.run(["git", *name, *arguments], cwd=tmp_path, check=True, capture_output=True)

    git("init")
    (tmp_path / "a.py").write_text("A = 1\n")
    git("add", ".")
    git("commit", "-m", "Add a module")
    (tmp_path / "a.py").write_text("B = 1\n")
    assert [unit.name for unit in sources.of_commit(tmp_path, "HEAD", "a.py").units] == ["A"]
    assert sources.of_commit(tmp_path, "HEAD", "gone.py").units == ()
