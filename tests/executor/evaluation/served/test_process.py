"""The process of an evaluation: what it says of a job, and what it refuses."""

from __future__ import annotations

import base64
import io
import json
import os
import socket
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from executor.evaluation.outcome import Outcome
from executor.evaluation.served.process import MOST_LINE_BYTES, run_job, shortened
from executor.evaluation_messages import (
    EvaluationDone,
    Refused,
    RunDone,
    Started,
    StartEvaluation,
    decode_from_evaluation,
)
from executor.supervision.channel import encode
from executor.supervision.single_threaded import SINGLE_THREADED

EXAMPLE = Path(__file__).parents[4] / "examples" / "laser_bump_and_go"
QUICK = b"""format: bt-studio/evaluation
version: 1
universe: walled_room
duration_s: 1
runs: 3
seed: 5
judge: {success: [{never: collision}]}
"""


TREE_ALONE = QUICK.replace(b"{never: collision}", b"{tree: SUCCESS}")


def archive(evaluation: bytes = QUICK, **more: bytes) -> str:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as made:
        for path in sorted(EXAMPLE.rglob("*")):
            if path.is_file():
                made.writestr(str(path.relative_to(EXAMPLE)), path.read_bytes())
        for name, data in {"evaluations/quick.yaml": evaluation, **more}.items():
            made.writestr(name, data)
    return base64.b64encode(out.getvalue()).decode()


def said(job: StartEvaluation) -> list:
    """Runs the process with a job, as the manager does; returns its messages."""
    ours, theirs = socket.socketpair()
    command = [
        sys.executable,
        "-m",
        "executor.evaluation.served.process",
        "--channel-fd",
        str(theirs.fileno()),
    ]
    with subprocess.Popen(
        command, pass_fds=[theirs.fileno()], env={**os.environ, **SINGLE_THREADED}
    ) as process:
        theirs.close()
        ours.sendall(encode(job))
        found = []
        with ours, ours.makefile("rb") as stream:
            while prefix := stream.read(4):
                found.append(decode_from_evaluation(stream.read(int.from_bytes(prefix, "little"))))
    assert process.returncode == 0
    return found


@pytest.mark.simulation
def test_it_runs_what_is_not_known_and_records_a_seed(tmp_path):
    job = StartEvaluation(archive(), "quick", [], [(5, "success")])
    begun, *runs, ended = said(job)
    assert isinstance(begun, Started)
    assert (begun.seed, begun.wanted, begun.duration_s) == (5, 3, 1.0)
    assert sorted(run.seed for run in runs) == [6, 7]
    assert [(run.done, run.wanted, run.rate) for run in runs] == [(2, 3, 1.0), (3, 3, 1.0)]
    assert ended == EvaluationDone(3)
    file = tmp_path / "run" / "0.0.mcap"
    job = StartEvaluation(archive(), "quick", [6], [], record_to=str(file))
    _, again, ended = said(job)
    assert isinstance(again, RunDone)
    assert again.line == next(run.line for run in runs if run.seed == 6)
    assert file.read_bytes().startswith(b"\x89MCAP")


@pytest.mark.simulation
def test_sealed_runs_come_to_the_same_outcomes():
    plain = {
        run.seed: run.line
        for run in said(StartEvaluation(archive(), "quick", [5], []))
        if isinstance(run, RunDone)
    }
    sealed = said(StartEvaluation(archive(), "quick", [5], [], sealed=True))
    assert {run.seed: run.line for run in sealed if isinstance(run, RunDone)} == plain
    assert isinstance(sealed[-1], EvaluationDone)


@pytest.mark.simulation
def test_launch_nodes_are_left_out_and_named():
    launch = b"<launch>\n<node pkg='demo' exec='talker' name='talker'/>\n</launch>\n"
    job = StartEvaluation(archive(**{"launch/robot.launch.xml": launch}), "quick", [], [], runs=1)
    begun, *_, ended = said(job)
    assert isinstance(begun, Started)
    assert begun.notes.startswith("launch/robot.launch.xml:2:1: the launch node talker is left out: ")
    assert isinstance(ended, EvaluationDone)


@pytest.mark.parametrize(
    ("job", "text"),
    [
        (StartEvaluation(archive(TREE_ALONE), "quick", [], [], sealed=True), "actions only claim"),
        (StartEvaluation("x", "quick", [], []), "no base64"),
        (StartEvaluation("eA==", "quick", [], []), "BT0920"),
        (StartEvaluation(archive(), "quikc", [], []), "did you mean 'quick'?"),
        (StartEvaluation(archive(QUICK.replace(b"walled_room", b"nowhere")), "quick", [], []), "nowhere"),
        (StartEvaluation(archive(b"runs: ["), "quick", [], []), "evaluations/quick.yaml:2:1"),
    ],
)
def test_what_cannot_be_run_is_refused_with_its_place(job, text):
    found: list = []
    run_job(job, found.append)
    [refused] = found
    assert isinstance(refused, Refused)
    assert text in refused.message


def test_a_cluster_that_is_not_there_is_refused_by_name():
    found: list = []
    run_job(StartEvaluation(archive(), "quick", [], []), found.append, "127.0.0.1:1")
    [refused] = found
    assert isinstance(refused, Refused)
    assert "127.0.0.1:1: nothing answers there" in refused.message


def test_a_line_that_is_too_long_loses_what_code_of_the_user_made_long():
    plain = Outcome(3, "success", "fine", drawn={"a": 1})
    assert shortened(plain) == plain.to_line()
    long = Outcome(3, "success", "fine", measures={"a": 1.0}, drawn={"a": "x" * MOST_LINE_BYTES})
    assert json.loads(shortened(long))["measures"] == {"a": 1.0}
    huge = Outcome(3, "failure", "x" * 10_000_000, measures={"m" * MOST_LINE_BYTES: 1.0})
    assert len(shortened(huge)) <= MOST_LINE_BYTES
