"""Reports and comparisons come from a child; what it says is checked."""

from __future__ import annotations

import subprocess
from types import SimpleNamespace

import pytest

from backend.evaluations import results, writes
from backend.evaluations.errors import ReportError, WrongStateError
from backend.evaluations.executor_events import read_line
from backend.evaluations.models import Evaluation
from tests.backend.evaluations.conftest import begin, done, store, wish

pytestmark = pytest.mark.django_db(transaction=True)


def compared(people):
    found = wish(people)
    begin(found, notes="a.launch.xml:2:1: the launch node talker is left out")
    store(found, done(0), done(1, "failure", 2))
    writes.store(found, 0, [(done(seed), read_line(done(seed))) for seed in (0, 1)])
    Evaluation.objects.filter(id=found.id).update(older=0)
    found.refresh_from_db()
    return found


def test_a_comparison_is_that_of_both_revisions(people):
    found = results.comparison_of(compared(people))
    assert (found.only_older, found.only_newer, found.both) == ([1], [], 1)
    assert found.measures[0].name == "path_length_m"


def test_a_report_is_a_page_of_its_own(people):
    with results.report_of(compared(people)) as file:
        file.seek(0)
        page = file.read().decode()
    assert page.startswith("<!doctype html>")
    assert '"project":"Robot"' in page
    assert "the launch node talker is left out" in page


def test_there_is_nothing_to_report_or_to_compare(people):
    found = wish(people)
    with pytest.raises(WrongStateError):
        results.report_of(found)
    with pytest.raises(WrongStateError):
        results.comparison_of(found)


@pytest.mark.parametrize(
    ("code", "text"), [(1, b"{}"), (0, b"no json"), (0, b'{"p": "x"}')], ids=["fails", "text", "another"]
)
def test_a_child_that_fails_is_an_error_and_no_traceback(people, monkeypatch, code, text):
    found = compared(people)

    def run(*_, stdout, **__):
        stdout.write(text)
        return SimpleNamespace(returncode=code, stderr=b"Traceback")

    monkeypatch.setattr(subprocess, "run", run)
    with pytest.raises(ReportError):
        results.comparison_of(found)
