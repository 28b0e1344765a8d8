"""The weight counts what was written for this version and runs, and nothing that formatting changes."""

from __future__ import annotations

import subprocess

import pytest

from tests.tools import weight
from tests.tools.weight import Weight

PYTHON = '''"""A docstring."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

# A comment.
LIMIT = 3  # and one beside code


class Counter:
    """Counts."""

    limit: int = LIMIT

    def ticks(self) -> Iterator[int]:
        """Yields numbers.

        In order.
        """
        import math

        text = """one
two"""

        yield from (
            1,
            math.floor(2.5),
        )
        yield len(text)
'''

PAGE = """import { a } from './a';
export { b } from './b';

/** A type. */
interface Props {
  // its field
  readonly count: number;
}

export function Row({ count }: Props) {
  // a comment

  const text = `one
two`;
  if (count > a) {
    return null;
  }
  return (
    <b>
      {/* nothing */}

      {text}
    </b>
  );
}
"""


def test_statements_and_lines_of_python():
    # LIMIT, the class, its field, its method, text, and two times yield
    assert weight.weigh_python(PYTHON) == Weight(7, 11)


@pytest.mark.parametrize("source", ["", '"""Text."""\n', "import a\n\n\n# nothing\n"])
def test_python_that_does_nothing_has_no_weight(source):
    assert weight.weigh_python(source) == Weight(0, 0)


def test_formatting_changes_no_statements():
    short, long = "def f(): return [1, 2]\n", "def f():\n    return [\n        1,\n        2,\n    ]\n"
    assert weight.weigh_python(short).statements == weight.weigh_python(long).statements == 2


def test_statements_and_lines_of_typescript(tmp_path):
    paths = [tmp_path / "Row.tsx", tmp_path / "empty.ts"]
    paths[0].write_text(PAGE)
    paths[1].write_text("// nothing\nimport './style.css';\n")
    # the interface and its field, the function, text, if, and two times return
    assert weight.weigh_page(paths) == {paths[0]: Weight(7, 15), paths[1]: Weight(0, 0)}


@pytest.mark.parametrize(
    ("name", "is_counted"),
    [
        ("backend/sessions/views.py", True),
        ("frontend/src/App.tsx", True),
        ("tree_gardener/generated/writer.py", True),
        ("backend/sessions/migrations/0001_initial.py", False),
        ("frontend/src/generated/messages.ts", False),
        ("docs/README.md", False),
    ],
)
def test_generated_files_and_migrations_do_not_count(name, is_counted):
    assert weight.is_counted(name) == is_counted


@pytest.mark.parametrize(
    ("name", "within", "room"),
    [
        ("backend/sessions/launchers/base.py", "", "backend/sessions"),
        ("backend/sessions/launchers/kubernetes/ends.py", "backend/sessions", "backend/sessions/launchers"),
        ("frontend/src/features/canvas/Canvas.tsx", "", "frontend/src/features"),
        ("conftest.py", "", "."),
    ],
)
def test_rooms(name, within, room):
    assert weight.room_of(name, within) == room


def test_tests_are_counted_apart(tmp_path):
    files = {
        "backend/core/a.py": "a = 1\nb = 2\n",
        "tests/backend/test_a.py": "assert True\n",
        "frontend/src/model/a.test.ts": "it('counts', () => {\n  go();\n});\n",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    product, tests = weight.table(weight.weigh(tmp_path, [*files, "gone.py"])).split("\n\n")
    assert [line.split() for line in product.splitlines()[1:]] == [
        ["2", "2", "backend/core"],
        ["2", "2", "the", "product"],
    ]
    assert tests.splitlines()[-1].split() == ["3", "4", "tests"]


def test_an_older_revision_is_counted_as_it_was(tmp_path, monkeypatch, capsys):
    git = ("git", "-c", "user.name=a", "-c", "user.email=a@b", "-C", str(tmp_path))
    (tmp_path / "translator").mkdir()
    (tmp_path / "translator" / "a.py").write_text("a = 1\n")
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "Begin"]):
        subprocess.run([*git, *command], check=True)
    (tmp_path / "translator" / "a.py").write_text("a = 1\nb = 2\nc = 3\n")
    monkeypatch.setattr(weight, "ROOT", tmp_path)
    counted = []
    for arguments in (["--at", "HEAD"], [], ["translator"], ["backend"]):
        assert weight.main(arguments) == 0
        counted.append(capsys.readouterr().out.partition(" the product")[0].split()[-2:])
    assert counted == [["1", "1"], ["3", "3"], ["3", "3"], ["0", "0"]]
