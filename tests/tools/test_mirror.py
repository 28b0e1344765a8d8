"""A module has a test file of its own, or is on the list that only shrinks."""

from __future__ import annotations

import pytest

from tests.tools import mirror

ERROR = "class E(Exception):\n    def __init__(self, a):\n        super().__init__(a)\n        self.a = a\n"


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
    test.write_text("from backend.projects import other\n\ndef test_one():\n    assert other\n")
    assert not mirror.is_mirrored(module), "another module of the package"


def test_what_a_package_exports_counts_for_the_module_that_defines_it(tmp_path, monkeypatch):
    monkeypatch.setattr(mirror, "ROOT", tmp_path)
    module = tmp_path / "translator" / "check" / "run.py"
    test = tmp_path / "tests" / "translator" / "check" / "test_run.py"
    for path in (module, test):
        path.parent.mkdir(parents=True)
    module.write_text("def check(): ...\n")
    test.write_text("from translator import check\n\ndef test_one():\n    assert check\n")
    assert mirror.is_mirrored(module)
    test.write_text("from translator import load\n\ndef test_one():\n    assert load\n")
    assert not mirror.is_mirrored(module)


@pytest.mark.parametrize(
    ("source", "is_declaration"),
    [
        ("X = 5\nclass A:\n    x: int = 3\n", True),
        (ERROR, True),
        ("class P(Protocol):\n    def go(self) -> int: ...\n", True),
        ("class B:\n    def go(self):\n        raise NotImplementedError\n", True),
        ("class A:\n    @property\n    def x(self):\n        return self._x\n", True),
        ("def double(x):\n    return 2 * x\n", False),
        ("def first(x):\n    return x[0]\n", False),
        ("def go():\n    start()\n", False),
        ("for name in NAMES:\n    register(name)\n", False),
    ],
)
def test_a_module_that_only_declares_needs_no_test_file(tmp_path, source, is_declaration):
    module = tmp_path / "module.py"
    module.write_text(source)
    assert mirror.is_declaration(module) is is_declaration


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


def test_a_module_of_the_page_that_only_has_types_needs_no_test(tmp_path):
    module = tmp_path / "messages.ts"
    for text, is_bare in [
        ("export type A = 1;\nexport interface B {}\n", True),
        ("export type A = 1;\nexpose(a);\n", False),
        ("export type A = 1;\nexport const a = 1;\n", False),
        ("export type A = 1;\nexport default function a() {}\n", False),
        ("export * from './a';\n", False),
        ("self.onmessage = answer;\n", False),
    ]:
        module.write_text(text)
        assert mirror.declares_types_alone(module) is is_bare, text
