"""Which dear tests run: the core, what changed, and a tenth of the others."""

from __future__ import annotations

import pytest

from tests.tools.selection.choose import (
    Reason,
    Selection,
    choose,
    core_of,
    core_patterns,
    drawn,
    matches,
)
from tests.tools.selection.table import Duration, Table, TableError, file_of

TESTS = [f"tests/test_{letter}.py::test_{number}" for letter in "abc" for number in range(20)]
TABLE = Table(tests={test: Duration((2.0,), 2.0) for test in TESTS})


def chosen(sample: str = "x") -> Selection:
    core = core_of({"walks": ["tests/test_a.py::test_1"]})
    return choose(TABLE, core, lambda file: file == "tests/test_b.py", sample)


def test_the_core_and_what_changed_run_and_a_tenth_of_the_others():
    selection = chosen()
    assert selection.tests(Reason.CORE) == ["tests/test_a.py::test_1"]
    assert {file_of(test) for test in selection.tests(Reason.CHANGED)} == {"tests/test_b.py"}
    assert len(selection.tests(Reason.SAMPLED)) == 4  # of 39, rounded up
    assert len(selection.tests(Reason.LEFT_OUT)) == 35


def test_a_sample_can_be_repeated_and_differs_with_the_tree():
    assert chosen("x") == chosen("x")
    assert chosen("x").tests(Reason.SAMPLED) != chosen("y").tests(Reason.SAMPLED)


def test_each_test_is_drawn_once_in_a_while():
    met = {test for sample in range(400) for test in drawn(TESTS, str(sample))}
    assert met == set(TESTS)


def test_cheap_tests_have_no_reason_and_so_run():
    table = Table(tests={"tests/test_a.py::test_x": Duration((0.9,), 60.0)})
    assert choose(table, lambda _: False, lambda _: False, "x").reasons == {}


def test_a_selection_is_read_as_it_was_saved(tmp_path):
    selection = chosen()
    selection.save(tmp_path / "below" / "selection.json")
    assert Selection.load(tmp_path / "below" / "selection.json") == selection


@pytest.mark.parametrize(
    ("pattern", "expected"),
    [
        ("tests/test_a.py", True),
        ("tests/test_a.py::test_x", True),
        ("tests/test_a.py::test_x[one]", True),
        ("tests/test_*.py::test_x*", True),
        ("tests/test_a.py::test_x[two]", False),
        ("tests/test_a", False),
        ("tests/test_a.py::test", False),
    ],
)
def test_a_pattern_names_a_file_a_test_a_case_or_many(pattern, expected):
    assert matches("tests/test_a.py::test_x[one]", pattern) is expected


@pytest.mark.parametrize("content", ["walks = 'a'", "walks = [1]", "walks = ["])
def test_a_core_of_another_form_is_refused(tmp_path, content):
    path = tmp_path / "core.toml"
    path.write_text(content)
    with pytest.raises(TableError, match=r"core\.toml"):
        core_patterns(path)
