"""`bt-studio evaluate` as it is typed."""

from __future__ import annotations

import json
import shlex
import signal
import subprocess
import time

import pytest

from backend.cli.evaluating.evaluate import ONLY_FAILED
from tests.budget import count
from tests.cli.typed import EVALUATING, ROOT, STUDIO
from tests.cli.typed import evaluating as studio
from tests.executor.evaluation.projects import DRIVE, write

ALONE = count("evaluation_alone")
RUNS = max(6, ALONE)
TEXT = f"""duration_s: 3
runs: {RUNS}
vary: {{robot.pose: {{area: start, yaw: [-0.4, 0.4]}}, models.crate.pose.y: [1, 3]}}
judge: {{success: [{{reach: {{area: ahead}}}}], measure: [path_length_m, smallest_clearance_m]}}
"""
SETS = DRIVE.replace(
    "        twist = Twist()",
    """        words = {"alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta"}
        twist = Twist()
        twist.angular.z = len(next(iter(words))) / 100""",
)
pytestmark = [pytest.mark.simulation, pytest.mark.timeout(300)]


def test_workers_change_nothing_and_a_seed_alone_gives_the_same(tmp_path):
    folder = write(tmp_path / "p", TEXT, action=SETS)
    one = studio("evaluate", folder, "--workers", 1, "--report", tmp_path / "one", "--gate", "success>=0.95")
    assert one.returncode == 1
    assert f"cannot pass with {RUNS} runs: it needs at least 59 of 59" in one.stderr
    assert "Traceback" not in one.stderr
    assert "a run takes about" in one.stdout
    assert "gate success>=0.95: FAILS" in one.stdout
    two = studio(
        "evaluate",
        folder,
        "main",
        "--workers",
        2,
        "--report",
        tmp_path / "two",
        "--junit",
        tmp_path / "j.xml",
    )
    assert (two.returncode, two.stderr) == (0, "")
    lines = (tmp_path / "one" / "runs.jsonl").read_bytes()
    assert (tmp_path / "two" / "runs.jsonl").read_bytes() == lines
    assert len(lines.splitlines()) == RUNS
    assert (tmp_path / "two" / "report.html").stat().st_size > 10_000
    assert f'tests="{RUNS}"' in (tmp_path / "j.xml").read_text()
    for seed in range(RUNS - ALONE, RUNS):
        alone = studio("run", folder, "--evaluation", "main", "--seed", seed, "--json")
        assert alone.stdout.splitlines()[-1] == lines.decode().splitlines()[seed]

    # Some runs fail; only these run again, and the other results stay.
    failed = [json.loads(line)["seed"] for line in lines.splitlines() if b'"outcome":"failure"' in line]
    assert 0 < len(failed) < RUNS
    again = studio("evaluate", folder, "--only-failed", "--report", tmp_path / "two")
    assert again.returncode == 0
    kept = (tmp_path / "two" / ONLY_FAILED / "runs.jsonl").read_text().splitlines()
    assert [json.loads(line)["seed"] for line in kept] == failed
    assert (tmp_path / "two" / "runs.jsonl").read_bytes() == lines


def test_an_interrupted_evaluation_continues(tmp_path):
    runs = max(20, RUNS + 1)  # so many that the signal comes before the last one
    folder, report = write(tmp_path / "p", TEXT.replace(f"runs: {RUNS}", f"runs: {runs}")), tmp_path / "r"
    command = [*STUDIO, "evaluate", str(folder), "--workers", "1", "--report", str(report)]
    with subprocess.Popen(
        command, cwd=ROOT, env=EVALUATING, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        part = report / "runs.part.jsonl"
        end_s = time.monotonic() + 200
        while not (part.exists() and part.read_bytes().count(b"\n") >= 2) and time.monotonic() < end_s:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        said, wrong = process.communicate(timeout=60)
    assert process.returncode == 1
    words = shlex.join(["bt-studio", *command[len(STUDIO) :], "--resume"])
    assert f"To continue: {words}" in wrong
    assert "incomplete" in said
    done = (report / "runs.jsonl").read_bytes()
    assert 2 <= len(done.splitlines()) < runs
    resumed = studio("evaluate", folder, "--report", report, "--resume")
    assert (resumed.returncode, resumed.stderr) == (0, "")
    whole = (report / "runs.jsonl").read_bytes()
    assert whole.startswith(done)
    assert len(whole.splitlines()) == runs
    again = studio("evaluate", folder, "--report", report)
    assert again.returncode == 2
    assert "holds the results of an earlier evaluation" in again.stderr
    assert (report / "runs.jsonl").read_bytes() == whole
    (folder / "actions" / "Drive.py").write_text(SETS)
    other = studio("evaluate", folder, "--report", report, "--resume")
    assert other.returncode == 2
    assert "another version of the project" in other.stderr
    assert (report / "runs.jsonl").read_bytes() == whole


def test_results_of_another_platform_are_named_and_refused_if_asked_for(tmp_path):
    folder, report = (
        write(tmp_path / "p", "duration_s: 1\nruns: 2\njudge: {success: [{never: collision}]}\n"),
        tmp_path / "r",
    )
    first = studio("evaluate", folder, "--report", report)
    assert first.returncode == 0, first.stderr
    header = json.loads((report / "evaluation.json").read_text())
    header["fingerprints"] = [{**header["fingerprints"][0], "id": "other", "numpy": "1.0"}]
    (report / "evaluation.json").write_text(json.dumps(header))
    strict = studio("evaluate", folder, "--report", report, "--resume", "--strict")
    assert strict.returncode == 2
    assert "the results are of another platform (--strict)" in strict.stderr
    assert "numpy: 1.0 then" in strict.stderr
    resumed = studio("evaluate", folder, "--report", report, "--resume")
    assert resumed.returncode == 0
    assert "warning: the results were made on another platform: numpy: 1.0 then" in resumed.stderr.replace(
        "\n", " "
    )
    prints = json.loads((report / "evaluation.json").read_text())["fingerprints"]
    assert [each["id"] == "other" for each in prints] == [True, False]
    assert all(each["id"] in (report / "report.html").read_text() for each in prints)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--gate", "better"], "is no gate"),
        (["--seeds", "1,x"], "write numbers"),
        (["--seeds", "-1"], "a seed is"),
        (["--resume"], "name the folder"),
        (["--runs", "3", "--seeds", "1"], "leave out all but one"),
        (["other"], "there is no such evaluation"),
    ],
)
def test_bad_arguments_have_the_status_two(tmp_path, options, words):
    done = studio("evaluate", write(tmp_path, TEXT), *options)
    assert done.returncode == 2
    assert words in done.stderr.replace("\n", " ")
    assert "Traceback" not in done.stderr


def test_a_sealed_run_is_judged_by_another_project_and_needs_more_than_a_claim(tmp_path):
    judge = write(tmp_path / "judge", TEXT.replace("duration_s: 3", "universe: yard\nduration_s: 3"))
    own = write(tmp_path / "own", "duration_s: 1\nruns: 1\njudge: {success: [{tree: SUCCESS}]}\n")
    done = studio("evaluate", own, "--sealed")
    assert done.returncode == 2
    assert "evaluations/main.yaml:1:1: the judge asks for the result of the tree alone" in done.stderr
    done = studio(
        "evaluate", own, "main", "--judged-by", judge, "--sealed", "--seeds", "2", "--report", tmp_path / "r"
    )
    assert done.returncode == 0, done.stderr
    [line] = (tmp_path / "r" / "runs.jsonl").read_text().splitlines()
    again = studio("run", own, "--evaluation", "main", "--judged-by", judge, "--seed", "2", "--json")
    assert again.stdout.splitlines()[-1] == line
    assert json.loads(line)["drawn"].keys() == {"robot.pose", "models.crate.pose.y"}
    assert studio("run", own, "--judged-by", judge).returncode == 2


def test_evaluations_are_listed(tmp_path):
    folder = write(tmp_path, TEXT, **{"evaluations/second.yaml": "x"})
    assert studio("evaluate", folder, "--list").stdout == "main\nsecond\n"
    done = studio("evaluate", folder)
    assert done.returncode == 2
    assert "there are 2 evaluations: name one of main, second" in done.stderr
