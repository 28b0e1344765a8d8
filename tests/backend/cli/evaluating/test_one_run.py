"""`bt-studio run --evaluation` as it is typed."""

from __future__ import annotations

import json

import pytest

from backend.cli.evaluating.one_run import open_plan, outcome_lines
from backend.cli.shared.errors import CliError
from executor.evaluation.outcome import Outcome
from tests.cli.typed import evaluating as studio
from tests.executor.evaluation.projects import write
from tests.executor.expansion.probes import probes, robot_of, was_refused

GOOD = "duration_s: 4\nruns: 2\njudge: {success: [{reach: {area: ahead}}], measure: [path_length_m]}\n"


def test_what_the_terminal_says():
    item = {"item": "reach door", "holds": False, "at_s": None, "margin": -0.25, "unit": "m"}
    outcome = Outcome(7, "failure", "reach door", 60, [item], {"path_length_m": 3.5}, {"robot.pose.x": 1.5})
    assert list(outcome_lines(outcome)) == [
        "failure after 60.00 s with seed 7: reach door",
        "    FAILS  reach door by 0.25 m",
        "    path_length_m = 3.5",
        "    drawn  robot.pose.x = 1.5",
    ]


@pytest.mark.simulation
@pytest.mark.timeout(300)
def test_one_seed_is_run_and_its_outcome_is_the_exit_status(tmp_path):
    folder = write(tmp_path / "p", GOOD)
    report, recording = tmp_path / "r.json", tmp_path / "r.mcap"
    done = studio(
        "run", folder, "--evaluation", "main", "--seed", 3, "--report", report, "--record", recording
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "success after" in done.stdout
    assert "holds  reach ahead" in done.stdout
    assert json.loads(report.read_text())["seed"] == 3
    assert recording.stat().st_size > 1000
    failing = write(tmp_path / "q", GOOD.replace("ahead", "behind"))
    done = studio("run", failing, "--evaluation", "main", "--json")
    assert done.returncode == 1
    assert json.loads(done.stdout.splitlines()[-1])["outcome"] == "failure"


@pytest.mark.parametrize(
    ("text", "options", "words"),
    [
        (GOOD.replace("ahead", "nowhere"), [], "evaluations/main.yaml:5:"),
        (GOOD, ["--duration", "3"], "the evaluation decides this"),
        (GOOD, ["--universe", "house"], "the evaluation decides this"),
        ("universe: none\n" + GOOD, [], "cannot be evaluated"),
    ],
)
def test_what_cannot_run_says_why(tmp_path, text, options, words):
    done = studio("run", write(tmp_path, text), "--evaluation", "main", *options)
    assert done.returncode == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr


def test_no_macro_of_a_robot_reads_outside_of_the_judge_s_project(tmp_path):
    (tmp_path / "secret.yaml").write_text("word: hidden")
    project, judge = write(tmp_path / "p", GOOD), write(tmp_path / "j", f"robot: r\n{GOOD}")
    for probe in probes(tmp_path / "secret.yaml"):
        for path, data in robot_of(probe).items():
            (judge / path).parent.mkdir(parents=True, exist_ok=True)
            (judge / path).write_bytes(data)
        with pytest.raises(CliError) as error:
            open_plan(str(project), "main", judged_by=str(judge))
        assert str(error.value).startswith("robots/r/r.xacro:2:1: BTR002 xacro: ")
        assert was_refused(str(error.value))
