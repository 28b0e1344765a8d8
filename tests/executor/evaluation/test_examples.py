"""The evaluations of the examples: a seeded fault in *bump and go* is caught by the gate."""

from __future__ import annotations

import json
import re
import shutil

import pytest
from mcap.reader import make_reader

from executor.evaluation.plan import make_plan
from executor.evaluation.run import AFTER_S
from tests.cli.typed import ROOT
from tests.cli.typed import evaluating as studio
from translator import open_path

EXAMPLE = ROOT / "examples" / "laser_bump_and_go"
GATE = ("--gate", "rate(success)>=0.95", "--seeds", "0,1,2")


@pytest.mark.parametrize(
    ("example", "name"), [("laser_bump_and_go", "room"), ("visual_follow_person", "follow")]
)
def test_the_examples_have_evaluations(example, name):
    plan = make_plan(open_path(ROOT / "examples" / example), name)
    assert plan.evaluation.most_runs >= 100


@pytest.mark.simulation
@pytest.mark.timeout(300)
def test_a_seeded_fault_in_bump_and_go_is_caught_by_gate_and_coverage_and_played(tmp_path):
    sound = studio("evaluate", EXAMPLE, *GATE, "--report", tmp_path / "sound")
    assert (sound.returncode, "passes" in sound.stdout) == (0, True), sound.stdout
    faulty = shutil.copytree(EXAMPLE, tmp_path / "faulty")
    tree = faulty / "trees" / "MainTree.json"
    tree.write_text(tree.read_text().replace('"obs_dist": "1.0"', '"obs_dist": "0.1"'))
    found = studio("evaluate", faulty, *GATE, "--report", tmp_path / "found")
    assert found.returncode == 1
    assert "gate rate(success)>=0.95: FAILS" in found.stdout
    assert "never closer than 0.05 m to models" in found.stdout
    assert "--evaluation room --seed " in found.stdout  # the command that plays it again
    assert never_ticked(tmp_path / "sound") == set()
    assert never_ticked(tmp_path / "found") == {"Turn::5"}
    the_worst_is_played(faulty, tmp_path)


def never_ticked(report):
    """The blocks that no run ticked, as the page of the results shows them."""
    text = (report / "report.html").read_text()
    shown = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL)
    assert shown is not None
    return {row["node"] for row in json.loads(shown[1])["coverage"] if row["runs"] == 0}


def the_worst_is_played(project, folder):
    """The run that its seed repeats is decided as in the evaluation, and its recording holds that moment."""
    lines = [json.loads(line) for line in (folder / "found" / "runs.jsonl").read_text().splitlines()]
    worst = next(line for line in lines if line["outcome"] == "failure")
    recording = folder / "worst.mcap"
    options = ("--evaluation", "room", "--seed", worst["seed"], "--record", recording, "--json")
    played = studio("run", project, *options)
    assert played.returncode == 1
    assert json.loads(played.stdout.splitlines()[-1]) == worst
    with recording.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    assert summary.statistics.message_end_time / 1e9 == pytest.approx(worst["end_s"] + AFTER_S, abs=0.1)
