"""`bt-studio tune` as it is typed."""

from __future__ import annotations

import json

import pytest

from backend.cli.evaluating.one_run import open_plan
from backend.cli.evaluating.tune import MOST_TRIAL_RUNS, write_best
from backend.cli.shared.errors import CliError
from executor.evaluation.outcome import Outcome
from executor.evaluation.statistics import Difference
from executor.evaluation.tuning.space import read_ports
from executor.evaluation.tuning.study import Trial
from executor.evaluation.tuning.tune import Candidate, Objective, Tuned
from tests.cli.typed import evaluating as studio
from tests.executor.evaluation.projects import write

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(400)]
TEXT = """duration_s: 2
runs: 8
judge: {success: [{reach: {area: ahead}}], measure: [path_length_m]}
"""
PORT = "MainTree.go.speed=0.1..1.0"


def test_a_study_finds_the_speed_that_arrives_and_writes_it(tmp_path):
    folder, report = write(tmp_path / "p", TEXT), tmp_path / "r"
    options = ("--port", PORT, "--trials", 3, "--runs", 1, "--fresh-runs", 8)
    done = studio("tune", folder, "main", *options, "--report", report, "--apply", "--seed", 1)
    assert done.returncode == 0, done.stderr
    found = json.loads((report / "tuning.json").read_text())
    assert [trial["number"] for trial in found["trials"]] == [0, 1, 2]
    best = found["best"][0]["values"]["MainTree.go.speed"]
    assert best > 0.55
    assert found["today"]["rate"] < found["best"][0]["rate"] == 1
    assert "the best values change success by +100.0%" in done.stdout
    tree = json.loads((folder / "trees" / "MainTree.json").read_text())
    assert float(tree["nodes"]["a"]["ports"]["speed"]) == best
    assert (report / "report.html").stat().st_size > 5_000


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--port", "MainTree.go.sped=0..1"], "there is no such port"),
        (["--port", PORT, "--maximise", "joy"], "is not measured; there are success, path_length_m"),
        (["--port", PORT, "--maximise", "success", "--minimise", "path_length_m"], "leave out one"),
    ],
)
def test_bad_arguments_have_the_status_two(tmp_path, options, words):
    folder = write(tmp_path / "p", TEXT)
    done = studio("tune", folder, "main", *options, "--report", tmp_path / "r")
    assert done.returncode == 2
    assert words in " ".join(done.stderr.replace("│", " ").split())
    assert "Traceback" not in done.stderr
    assert MOST_TRIAL_RUNS == 50


def test_a_tree_that_was_changed_meanwhile_is_not_written(tmp_path):
    folder = write(tmp_path / "p", TEXT)
    plan, tree = open_plan(str(folder), "main"), folder / "trees" / "MainTree.json"
    [port] = read_ports([PORT], plan)
    runs = tuple(Outcome(seed, "success") for seed in range(9))
    low, high = Difference(0.0, 0.0, 0.0), Difference(0.5, 0.2, 0.8)
    trial = Trial(0, {port.address: 0.75}, 1.0)
    best, today = Candidate(trial, runs, 1.0, high), Candidate(None, runs, 0.5, low)
    tuned = Tuned((port,), Objective(), (trial,), today, (best,))
    own = tree.read_text().replace("{", "{ ", 1)
    tree.write_text(own)
    with pytest.raises(CliError, match=r"changed during the study, so nothing was written: set .* = 0.75"):
        write_best(str(folder), plan, tuned)
    assert tree.read_text() == own
    write_best(str(folder), open_plan(str(folder), "main"), tuned)
    assert json.loads(tree.read_text())["nodes"]["a"]["ports"] == {"speed": "0.75"}
