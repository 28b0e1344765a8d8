"""A test file can read its imports, what its processes load, data by rules, and what no rule knows."""

from __future__ import annotations

import grimp
import pytest

from tests.tools.selection.inputs import Inputs
from tests.tools.selection.rules import NAMED, NOT_FOLLOWED, READ_AS_TEXTS, ROWS, Row, row_of
from tests.tools.selection.table import Executed
from tests.tools.selection.units import module_of

TREE = {
    path: path
    for path in (
        *(
            "translator/__init__.py",
            "translator/tree.py",
            "translator/xml/__init__.py",
            "translator/xml/read.py",
        ),
        *("translator/diagnostics.json", "executor/process.py", "executor/loop.py", "executor/robots/a.py"),
        *("executor/robots/r/robot.yaml", "backend/config/settings.py", "backend/urls.py", "pyproject.toml"),
        *(
            "tests/conftest.py",
            "tests/executor/conftest.py",
            "tests/executor/test_run.py",
            "tests/translator/test_t.py",
        ),
        *(
            "tests/backend/test_b.py",
            "docs/a.md",
            "frontend/src/a.ts",
            "frontend/src/a.test.ts",
            "tests/e2e/test_w.py",
        ),
    )
}
IMPORTS = [
    ("translator.xml.read", "translator.tree"),
    ("tests.translator.test_t", "translator.xml.read"),
    ("executor.process", "executor.loop"),
    ("executor.loop", "executor.robots.a"),
]


def inputs(loaded: dict[str, frozenset[str]] | None = None, rows: tuple[Row, ...] = ROWS) -> Inputs:
    graph = grimp.ImportGraph()
    for path in TREE:
        if path.endswith(".py"):
            graph.add_module(path.removesuffix(".py").removesuffix("/__init__").replace("/", "."))
    for importer, imported in IMPORTS:
        graph.add_import(importer=importer, imported=imported)
    return Inputs(TREE, graph, loaded or {}, rows)


def test_a_test_reads_what_it_imports_with_the_packages_above_and_their_data():
    assert inputs().of("tests/translator/test_t.py") == {
        *("tests/translator/test_t.py", "tests/conftest.py", "translator/xml/read.py", "translator/tree.py"),
        *(
            "translator/__init__.py",
            "translator/xml/__init__.py",
            "translator/diagnostics.json",
            "pyproject.toml",
        ),
    }


def test_a_test_reads_what_its_processes_load_with_what_that_imports():
    loaded = {"tests/executor/test_run.py": frozenset({"executor/process.py"})}
    found = inputs(loaded).of("tests/executor/test_run.py")
    assert {"executor/loop.py", "executor/robots/a.py", "executor/robots/r/robot.yaml"} <= found
    assert "executor/loop.py" not in inputs().of("tests/executor/test_run.py")


def test_what_is_named_in_texts_counts_as_read():
    assert {"backend/config/settings.py", "backend/urls.py"} <= inputs().of("tests/backend/test_b.py")


def test_the_page_counts_for_the_tests_with_a_browser_and_its_own_tests_do_not():
    assert "frontend/src/a.ts" in inputs().of("tests/e2e/test_w.py")
    assert "frontend/src/a.test.ts" not in inputs().of("tests/e2e/test_w.py")
    assert "docs/a.md" not in inputs().of("tests/e2e/test_w.py")


def test_a_path_that_no_rule_knows_touches_everything():
    assert inputs().unknown == {"pyproject.toml"}
    without = tuple(row for row in ROWS if row is not row_of("docs/a.md"))
    assert "docs/a.md" in inputs(rows=without).of("tests/translator/test_t.py")


def test_the_digest_changes_with_each_input_and_with_nothing_else():
    file = "tests/translator/test_t.py"
    before, reads = inputs().digest(file), inputs().of(file)
    for path in list(TREE):
        TREE[path] += " changed"
        try:
            assert (inputs().digest(file) != before) is (path in reads), path
        finally:
            TREE[path] = path


LAYERS = "from translator import tree\ndef read():\n    return tree.A\ndef idle():\n    return 1\n"


def digest_of(file: str, tree: dict[str, str] | None = None, sources: dict[str, str] | None = None) -> str:
    """The digest of a file whose tests ran `read`, and read a module as a text."""
    paths = {path: path for path in TREE} | (tree or {})
    graph = grimp.ImportGraph()
    for path in ("translator.tree", "translator.xml.read", "tests.translator.test_t"):
        graph.add_module(path)
    graph.add_import(importer="tests.translator.test_t", imported="translator.xml.read")
    graph.add_import(importer="translator.xml.read", imported="translator.tree")
    parts = {"translator/xml/read.py": LAYERS, "translator/tree.py": "A = 1\nB = 1\n", file: ""}
    own = {path: module_of(source) for path, source in (parts | (sources or {})).items()}
    executed = Executed(
        frozenset({("translator/xml/read.py", "read")}), texts=frozenset({"executor/loop.py"})
    )
    return Inputs(paths, graph, {}, executed={file: executed}, parts=lambda: own).digest(file)


def test_where_functions_are_known_only_they_count_with_data_and_texts():
    file = "tests/translator/test_t.py"
    before = digest_of(file)
    assert digest_of(file, {"translator/xml/read.py": "2", "translator/tree.py": "2"}) == before
    assert digest_of(file, sources={"translator/xml/read.py": LAYERS.replace("return 1", "...")}) == before
    assert digest_of(file, sources={"translator/tree.py": "A = 1\nB = 2\n"}) == before
    assert digest_of(file, sources={"translator/tree.py": "A = 2\nB = 1\n"}) != before
    assert digest_of(file, sources={"translator/xml/read.py": LAYERS.replace("tree.A", "...")}) != before
    for path in ("translator/diagnostics.json", "pyproject.toml", "executor/loop.py"):
        assert digest_of(file, {path: "2"}) != before, path


def test_a_module_that_an_import_brings_counts_with_its_effects():
    file = "tests/translator/test_t.py"
    importing = {"translator/tree.py": "import executor.loop\nA = 1\nB = 1\n", "executor/loop.py": ""}
    before = digest_of(file, sources=importing)
    assert before == digest_of(file)
    assert digest_of(file, sources=importing | {"executor/loop.py": "def idle(): ...\n"}) == before
    assert digest_of(file, sources=importing | {"executor/loop.py": "register(1)\n"}) != before


@pytest.mark.parametrize("file", [f"{NOT_FOLLOWED[0]}test_d.py", *NOT_FOLLOWED[1:], "tests/tools/test_x.py"])
def test_imports_stand_for_what_cannot_be_followed(file):
    tree = {file: "1"}
    found = Inputs(tree, grimp.ImportGraph(), {}, executed={file: Executed(frozenset())})
    assert found.reached(file) is None
    assert Inputs(tree, grimp.ImportGraph(), {}).digest(file) == found.digest(file)


@pytest.mark.parametrize(("reader", "read"), READ_AS_TEXTS)
def test_without_a_line_of_texts_a_test_would_be_missed(reader, read, monkeypatch):
    path, test = f"{read}module.py", reader if reader.startswith("tests/") else "tests/test_other.py"
    executed = {test: Executed(frozenset({(reader, "f")}))}

    def wholes() -> frozenset[str]:
        return Inputs({path: "1", test: "3"}, grimp.ImportGraph(), {}, executed=executed, parts=dict).wholes(
            test
        )

    assert path in wholes()
    others = tuple(row for row in READ_AS_TEXTS if row != (reader, read))
    monkeypatch.setattr("tests.tools.selection.inputs.READ_AS_TEXTS", others)
    assert path not in wholes()


@pytest.mark.parametrize(("row", "reader"), [(row, reader) for row in ROWS for reader in row.readers])
def test_without_a_line_of_the_table_a_test_would_be_missed(row, reader):
    """A path of the row, and a module below the reader: the one is read by the other only by this line."""
    path = row.data[-1].replace("*", "some.data")
    module = reader if reader.endswith(".py") else f"{reader}module.py"
    test = module if module.startswith("tests/") else "tests/test_other.py"
    tree = {path: "1", module: "2", test: "3"}
    assert row_of(path) is row

    def found(rows: tuple[Row, ...]) -> frozenset[str]:
        return Inputs(tree, grimp.ImportGraph(), {test: frozenset({module})}, rows).of(test)

    others = tuple(each for each in row.readers if each != reader)
    assert path in found(ROWS)
    assert path not in found(tuple(each._replace(readers=others) if each is row else each for each in ROWS))


def test_each_named_reader_is_in_the_tree():
    from tests.tools.selection import tree

    paths = tree.working_tree()
    pairs = [each for pair in (*NAMED, *READ_AS_TEXTS) for each in pair]
    for pattern in (*(reader for row in ROWS for reader in row.readers), *pairs, *NOT_FOLLOWED):
        assert any(path.startswith(pattern) for path in paths), pattern
