"""The evaluations of the examples: a seeded fault in *bump and go* is caught by the gate."""

from __future__ import annotations

import shutil

import pytest

from executor.evaluation.plan import make_plan
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
def test_a_seeded_fault_in_bump_and_go_is_caught_by_the_gate(tmp_path):
    sound = studio("evaluate", EXAMPLE, *GATE)
    assert (sound.returncode, "passes" in sound.stdout) == (0, True), sound.stdout
    faulty = shutil.copytree(EXAMPLE, tmp_path / "faulty")
    tree = faulty / "trees" / "MainTree.json"
    tree.write_text(tree.read_text().replace('"obs_dist": "1.0"', '"obs_dist": "0.1"'))
    found = studio("evaluate", faulty, *GATE)
    assert found.returncode == 1
    assert "gate rate(success)>=0.95: FAILS" in found.stdout
    assert "never closer than 0.05 m to models" in found.stdout
    assert "--evaluation room --seed " in found.stdout  # the command that plays it again
