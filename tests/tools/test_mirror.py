"""A module has a test file of its own, or is on the list that only shrinks."""

from __future__ import annotations

from tests.tools import mirror


def test_every_module_has_a_test_file_or_is_on_the_list(capsys):
    assert mirror.main([]) == 0, capsys.readouterr().out


def test_a_test_file_counts_if_it_imports_its_module_and_asserts(tmp_path, monkeypatch):
    monkeypatch.setattr(mirror, "ROOT", tmp_path)
    module = tmp_path / "backend" / "projects" / "names.py"
    test = tmp_path / "tests" / "backend" / "projects" / "test_names.py"
    test.parent.mkdir(parents=True)
    assert not mirror.is_mirrored(module)
    test.write_text("def test_one():\n    assert True\n")
    assert not mirror.is_mirrored(module)
    test.write_text("from backend.projects import names\n")
    assert not mirror.is_mirrored(module)
    test.write_text("from backend.projects import names\n\ndef test_one():\n    assert names\n")
    assert mirror.is_mirrored(module)


def test_a_test_of_the_page_stands_beside_its_module(tmp_path, monkeypatch):
    monkeypatch.setattr(mirror, "ROOT", tmp_path)
    module = tmp_path / "src" / "layout.ts"
    module.parent.mkdir()
    test = module.with_name("layout.test.tsx")
    test.write_text("import { layout } from './layout';\nit('lays out', () => expect(layout()).toBe(1));\n")
    assert mirror.is_mirrored(module)


def test_the_list_does_not_grow(tmp_path, monkeypatch):
    known = tmp_path / "unmirrored.txt"
    known.write_text("one\n")
    monkeypatch.setattr(mirror, "LIST", known)
    monkeypatch.setattr(mirror, "unmirrored", lambda: ["one", "two"])
    assert mirror.main(["--write"]) == 1
    assert known.read_text() == "one\n"
    monkeypatch.setattr(mirror, "unmirrored", lambda: ["moved"])
    assert mirror.main(["--write"]) == 0
    assert known.read_text() == "moved\n"
