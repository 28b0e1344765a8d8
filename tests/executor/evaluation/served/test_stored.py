"""Reports and comparisons of stored outcomes, as the web server asks for them."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from executor.evaluation.outcome import Outcome
from executor.evaluation.served.stored import comparison, report
from executor.evaluation.summary import pair

NEWER = [Outcome(seed, "success" if seed < 8 else "failure", measures={"m": 2.0}) for seed in range(10)]
OLDER = [Outcome(seed, "success" if seed % 2 else "failure", measures={"m": 1.0}) for seed in range(10)]
ABOUT = {
    "project": "Robot",
    "path": "Robot",
    "evaluation": "room",
    "wanted": 10,
    "most": 10,
    "sequential": False,
    "plan": {"outlines": [], "areas": [{"name": "door", "corners": []}]},
    "notes": ["launch/a.launch.xml:2:1: the launch node talker is left out"],
}


def asked(what: str, about: dict) -> str:
    lines = [json.dumps(about), *(o.to_line() for o in NEWER), "", *(o.to_line() for o in OLDER)]
    command = [sys.executable, "-m", "executor.evaluation.served.stored", what]
    done = subprocess.run(command, input="\n".join(lines), capture_output=True, text=True, check=True)
    return done.stdout


def test_a_comparison_names_the_seeds_whose_outcome_changed():
    found = json.loads(asked("compare", {}))
    assert found == json.loads(json.dumps(comparison(pair(OLDER, NEWER))))
    assert (found["only_older"], found["only_newer"]) == ([9], [0, 2, 4, 6])
    assert (found["both"], found["neither"]) == (4, 1)
    assert found["p"] == pytest.approx(0.375)  # binomial, 1 of 5, two-sided
    assert found["measures"] == [{"name": "m", "pairs": 10, "difference": [1.0, 1.0, 1.0]}]


def test_a_report_has_the_plan_of_the_world_and_the_comparison():
    page = asked("report", ABOUT)
    assert page == report(ABOUT, NEWER, OLDER)
    assert '"areas":[{"name":"door"' in page
    assert '"only_older":[9]' in page
    assert '"notes":["launch/a.launch.xml:2:1: the launch node talker is left out"]' in page
    assert report(ABOUT, NEWER, []).count('"against":null') == 1
