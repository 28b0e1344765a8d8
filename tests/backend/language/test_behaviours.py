"""Reports of tests that are completed by those that need Python."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import partial

import psutil
import pytest

from backend.core.processes.stops import Stop, StoppedError
from backend.language.behaviours import completed, run_beside, runner
from backend.language.errors import CheckerUnavailableError
from backend.language.tools import run_behaviours
from backend.workers.behaviours import run_tests
from tests.cli.typed import ROOT
from tests.deadline import wait_until
from tests.executor.tools.test_behaviours import HEAD, LEAF, REAL
from tests.executor.tools.test_behaviours import asked as asked_for
from translator.archive import read_folder


@pytest.fixture
def report():
    files = dict(read_folder(ROOT / "examples" / "laser_bump_and_go"))
    files["actions/Turn.py"] = LEAF.format(body="pass").encode()
    files["tests/bump_and_go.test.yaml"] = f"{HEAD}  - {{name: real, {REAL}".encode()
    return run_tests(files, with_job=True)


def test_a_real_leaf_runs_in_another_process_and_counts_in_the_coverage(report):
    job = report.pop("job")
    assert [test["outcome"] for test in report["tests"]] == ["needs_python"]
    assert report["coverage"]["share"] == 0
    found = completed(report, job, run_beside, Stop())
    assert [test["outcome"] for test in found["tests"]] == ["passed"]
    nodes = found["coverage"]["trees"]["MainTree"]["nodes"].values()
    assert {node["name"] for node in nodes if node["items"]["ticked"]} >= {"Turn", "CheckObstacle"}
    assert 0 < found["coverage"]["share"] < 1


def processes():
    """Returns those below this one that run; where it has adopted orphans, nobody buries them."""
    return {process for process in psutil.Process().children(recursive=True) if lives(process)}


def lives(process):
    with suppress(psutil.NoSuchProcess):
        return process.status() != psutil.STATUS_ZOMBIE
    return False


def with_tests(started):
    """Returns those that run tests, with their children: the pools of this process start others."""
    found = set()
    for process in started:
        with suppress(psutil.Error):
            if "tree_gardener.testing" in process.cmdline():
                found |= {process, *process.children(recursive=True)}
    return found


def answered(text, *_):
    return text


def test_what_the_process_forges_is_refused_and_what_it_leaves_out_is_not_run(report):
    job = report.pop("job")
    for text in ("", "[]", '{"results": [{"name": 1}]}', "\ud800"):
        with pytest.raises(CheckerUnavailableError):
            completed(report, job, partial(answered, text), Stop())
    found = completed(report, job, partial(answered, '{"results": []}'), Stop())
    assert [test["outcome"] for test in found["tests"]] == ["not_run"]
    other = {"name": "other", "file": "x", "ticks": 1, "failures": [], "seen": {"x": {"y": ["ticked"]}}}
    forged = partial(answered, json.dumps({"results": [other]}))
    assert completed(report, job, forged, Stop())["coverage"]["share"] == 0


def test_tests_that_are_ended_leave_no_process():
    asked, stop = json.dumps(asked_for("time.sleep(1000)", tests=1)), Stop()
    with ThreadPoolExecutor(1) as pool:
        before = processes()
        running = pool.submit(run_beside, asked, stop)
        wait_until(lambda: with_tests(processes() - before), "the test runs")
        its = with_tests(processes() - before)
        stop.set()
        assert running.result(60) == ""
    wait_until(lambda: not its & processes(), "no process of it is left")
    with pytest.raises(StoppedError):
        run_beside(asked, stop)


def test_without_such_tests_nothing_is_asked(report):
    report["tests"] = []
    assert completed(report, report.pop("job"), lambda *_: pytest.fail("asked"), Stop()) is report


def test_a_team_has_it_in_containers_or_not_at_all(team, settings_of, person):
    ada = person("ada").user
    with pytest.raises(CheckerUnavailableError):
        runner(ada)
    for with_containers in ("docker", "kubernetes"):
        settings_of(launcher=with_containers)
        found = runner(ada)
        assert isinstance(found, partial)
        assert found.func is run_behaviours


def test_on_this_machine_it_is_a_child_process(user):
    assert runner(user) is run_beside
