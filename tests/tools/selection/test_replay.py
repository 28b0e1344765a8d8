"""Past commits are laid on today's tree."""

from __future__ import annotations

import subprocess

import grimp

from tests.tools.selection.choose import Reason
from tests.tools.selection.inputs import Inputs
from tests.tools.selection.replay import (
    Change,
    Replay,
    change_of,
    changed_paths,
    commits,
    is_product,
    summary,
)
from tests.tools.selection.table import Duration, Executed, Table
from tests.tools.selection.units import differences, module_of

TREE = dict.fromkeys(
    ["tests/test_a.py", "tests/test_b.py", "translator/tree.py", "docs/a.md", "Makefile"], "1"
)
TABLE = Table(
    tests={f"tests/test_{letter}.py::test_x": Duration((60.0,), 60.0) for letter in "ab"},
    files={"tests/test_a.py": 66.0, "tests/test_b.py": 66.0},
    lanes={"page": 48.0},
    inputs={"tests/test_a.py": "1", "tests/test_b.py": "1"},
)
INPUTS = Inputs(TREE, grimp.ImportGraph(), {"tests/test_a.py": frozenset({"translator/tree.py"})})
REPLAY = Replay(TABLE, INPUTS, lambda _: False)


def touched(*paths: str) -> list[str]:
    return REPLAY.of(Change(frozenset(paths)), "x").tests(Reason.CHANGED)


def test_a_commit_touches_what_reads_its_paths():
    assert touched("translator/tree.py") == ["tests/test_a.py::test_x"]
    assert touched("docs/a.md") == []
    assert len(touched("Makefile")) == 2


def test_a_commit_touches_a_file_whose_functions_are_known_by_what_it_changes_in_them():
    module = module_of("A = 1\ndef f():\n    return A\ndef g():\n    return 2\n")
    inputs = Inputs(
        TREE,
        grimp.ImportGraph(),
        {},
        executed={"tests/test_a.py": Executed(frozenset({("translator/tree.py", "f")}))},
        parts=lambda: {"translator/tree.py": module, "tests/test_a.py": module_of("")},
    )
    replay = Replay(TABLE, inputs, lambda _: False)

    def touches(source: str, *others: str) -> bool:
        units = differences(module, module_of(source))
        change = Change(
            frozenset({"translator/tree.py", *others}),
            frozenset(("translator/tree.py", unit, is_doc) for unit, is_doc in units),
        )
        return replay.of(change, "x").reasons["tests/test_a.py::test_x"] is Reason.CHANGED

    assert touches("A = 1\ndef f():\n    return 3\ndef g():\n    return 2\n")
    assert touches("A = 2\ndef f():\n    return A\ndef g():\n    return 2\n")
    assert not touches("A = 1\ndef f():\n    return A\ndef g():\n    return 3\n")
    same = "A = 1\ndef f():\n    return A\ndef g():\n    return 2\n"
    assert not touches(same)
    assert touches(same, "Makefile")
    assert touches(same, "tests/test_a.py")


def test_a_path_that_is_gone_counts_where_no_importer_shows_it():
    assert len(touched("docker/old.lock")) == 2
    assert touched("translator/gone.py") == []


def test_minutes_are_those_of_all_that_would_run():
    assert REPLAY.minutes(REPLAY.of(Change(frozenset({"Makefile"})), "x")) == 3.0
    left_out = REPLAY.of(Change(frozenset({"docs/a.md"})), "x")
    assert REPLAY.minutes(left_out) == 2.0  # one of the two is drawn
    assert REPLAY.counts(left_out) == "0 core, 0 changed, 1 sampled, 1 left out"


def test_the_median_and_the_worst_stand_beside_the_whole():
    assert "median 2.0 min (0.67 of all 3.0), worst 3.0 (1.00)" in summary([1.0, 2.0, 3.0], 3.0)
    assert "no commit" in summary([], 3.0)


def test_commits_are_read_from_git(tmp_path):
    def git(*arguments):
        name = ("-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false")
        subprocess.run(["git", *name, *arguments], cwd=tmp_path, check=True, capture_output=True)

    git("init")
    for name in ("a.py", "b c.md"):
        (tmp_path / name).write_text("x")
        git("add", ".")
        git("commit", "-m", f"Add {name}")
    found = commits(tmp_path, 5)
    assert [subject for _, subject in found] == ["Add b c.md", "Add a.py"]
    assert [changed_paths(tmp_path, commit) for commit, _ in found] == [{"b c.md"}, {"a.py"}]
    assert change_of(tmp_path, found[1][0]).paths == {"a.py"}


def test_tests_of_the_page_are_no_product_code():
    assert is_product(frozenset({"frontend/src/a.ts"}))
    assert not is_product(frozenset({"frontend/src/a.test.ts", "docs/a.md", "tests/test_a.py"}))
