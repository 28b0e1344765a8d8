"""`make test` chooses by the table, and refuses bad input in one sentence."""

from __future__ import annotations

import sys

import pytest

from tests.tools import suite
from tests.tools.lanes import NOT_COMPLETE, PASSED, TESTS_FAILED, Lane
from tests.tools.selection.choose import Reason, core_patterns
from tests.tools.selection.table import ROOT, TableError, read


def lane(name: str, program: str) -> Lane:
    return Lane(name, [sys.executable, "-c", program], ROOT)


def test_lanes_run_beside_each_other_and_all_failures_are_listed(capfd):
    lanes = [lane("a", "print('FAILED tests/a.py::x')\nraise SystemExit(1)"), lane("b", "print('fine')")]
    assert suite.run(lanes) == TESTS_FAILED
    shown = capfd.readouterr().out
    assert shown.count("a      | FAILED tests/a.py::x") == 2
    assert shown.count("b      | fine") == 1
    assert suite.run([lane("b", "")]) == PASSED


def test_a_lane_that_takes_a_while_to_choose_runs_beside_those_that_began(capfd):
    lanes = [lane("a", "print('began')")]

    def later():
        assert lanes[0].ident is not None, "those that are given have started"
        return lane("b", "raise SystemExit(1)")

    assert suite.run(lanes, later) == TESTS_FAILED
    shown = capfd.readouterr().out
    assert "a      | began" in shown
    assert "b FAILED (1)" in shown


def test_a_lane_that_did_not_end_weighs_more_than_a_failure():
    lanes = [lane("a", "raise SystemExit(1)"), lane("b", "raise SystemExit(3)")]
    assert suite.run(lanes) not in (PASSED, TESTS_FAILED)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--full", "--shard", "9/8"], "SHARD=9/8: expected a part such as 3/8"),
        (["--shard", "x"], "SHARD=x: expected a part such as 3/8"),
    ],
)
def test_a_shard_that_there_is_not_is_refused_in_one_sentence(arguments, sentence, capfd):
    assert suite.main(arguments) == NOT_COMPLETE
    assert capfd.readouterr().err == f"tests: {sentence}\n"


def test_half_a_table_is_refused_in_one_sentence(monkeypatch, capfd):
    def refuse():
        raise TableError("durations.json is not a whole table; check it out again")

    monkeypatch.setattr(suite, "read", refuse)
    assert suite.main([]) == NOT_COMPLETE
    assert capfd.readouterr().err == "tests: durations.json is not a whole table; check it out again\n"


def test_the_table_names_files_that_there_are_and_the_core_names_tests_of_the_table():
    """A test that is gone loses its line in the next full run; its file must not be gone."""
    table = read()
    assert [file for file in table.inputs if not (ROOT / file).exists()] == []
    for heading, patterns in core_patterns().items():
        for pattern in patterns:
            file = pattern.partition("::")[0]
            assert list(ROOT.glob(file)), f"{heading}: {pattern}"


def test_what_runs_is_said_with_its_minutes():
    from tests.tools.selection.choose import choose
    from tests.tools.selection.table import Duration, Table

    table = Table(tests={"tests/a.py::x": Duration((120.0,), 120.0)})
    lines = list(suite.described(choose(table, lambda _: False, lambda _: True, "s"), table))
    assert f"tests  | 1 dear tests, 2.0 processor minutes: {Reason.CHANGED}" in lines
