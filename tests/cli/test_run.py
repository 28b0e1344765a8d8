"""`bt-studio run` and `bt-studio manager` as they are typed."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import time
from typing import Any

import pytest
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader

from executor.recorder.joining import join_newest
from tests.budget import count
from tests.cli.typed import ROOT, STUDIO, studio

EXAMPLE = ROOT / "examples" / "laser_bump_and_go"


@pytest.mark.simulation
@pytest.mark.parametrize("how", [["--lockstep"], []])
def test_a_run_writes_its_report(tmp_path, how):
    report = tmp_path / "r.json"
    done = studio("run", EXAMPLE, *how, "--duration", "3", "--seed", "1", "--report", report)
    assert (done.returncode, done.stderr) == (0, "")
    assert "The way is free" in done.stdout
    written = json.loads(report.read_text())
    assert written["root_status"] == "RUNNING"
    assert written["distance_m"] > 0.3
    assert written["collisions"] == 0
    assert written["errors"] == []
    assert written["trajectory"][-1][0] > 2.5
    assert written["nodes"][0]["path"] == "bump and go"


@pytest.mark.simulation
@pytest.mark.parametrize("how", [["--lockstep"], []])
def test_each_node_of_a_run_is_measured(tmp_path, how):
    recording, report = tmp_path / "r.mcap", tmp_path / "r.json"
    more = ["--duration", "3", "--profile", "--record", recording, "--report", report]
    done = studio("run", EXAMPLE, *how, *more)
    assert (done.returncode, done.stderr) == (0, "")
    head, *lines = done.stdout[done.stdout.index("\nnode ") :].splitlines()[1:]
    assert head.split()[:2] == ["node", "share"]
    assert {"bump", "keep"} < {line.split()[0] for line in lines}
    rows = {row["path"]: row for row in json.loads(report.read_text())["profile"]}
    assert rows["bump and go"]["calls"] > 30
    assert rows["bump and go"]["total_ms"] > rows["keep clear"]["total_ms"] > 0
    with AnyReader([recording]) as reader:
        connections = [each for each in reader.connections if each.topic == "/bt/profile"]
        parts: list[Any] = [
            reader.deserialize(raw, connection.msgtype)
            for connection, _, raw in reader.messages(connections=connections)
        ]
    calls = sum(int(part.calls[list(part.uid).index(1)]) for part in parts)
    assert (
        abs(calls - rows["bump and go"]["calls"]) <= 15
    )  # a session tells the last half second to the recorder alone


@pytest.mark.simulation
def test_a_run_ends_when_nobody_reads_what_it_prints():
    command = [*STUDIO, "run", str(EXAMPLE)]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as run:
        assert b"Traceback" not in run.stdout.readline()
        run.stdout.close()
        assert (run.wait(timeout=100), run.stderr.read()) == (1, b"")


@pytest.mark.simulation
@pytest.mark.parametrize("how", [["--lockstep"], []])
def test_an_action_that_raises_is_reported_with_its_line(tmp_path, how):
    project = tmp_path / "project"
    for file in EXAMPLE.rglob("*.*"):
        if file.is_file() and "__pycache__" not in file.parts:
            target = project / file.relative_to(EXAMPLE)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(file.read_bytes())
    forward = project / "actions" / "Forward.py"
    forward.write_text(forward.read_text().replace("twist = Twist()\n", "twist = Twost()\n"))
    done = studio("run", project, *how, "--duration", "5")
    assert done.returncode == 1
    assert "actions/Forward.py:21:1" in done.stderr
    assert "Twost" in done.stderr
    assert "Traceback" not in done.stderr


def test_bad_arguments_are_reported_in_one_line():
    done = studio("run", "does/not/exist")
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1


def test_a_port_in_use_is_reported_in_one_line():
    import socket

    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        done = studio("manager", "--port", taken.getsockname()[1])
    assert done.returncode == 1
    assert "cannot listen" in done.stderr
    assert "Traceback" not in done.stderr


def recorded(path):
    """Returns the messages of a recording by topic, with their times, as another reader finds them."""
    found: dict[str, list[tuple[int, Any]]] = {}
    with AnyReader([path]) as reader:
        for connection, time_ns, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            found.setdefault(connection.topic, []).append((time_ns, message))
    return found


@pytest.mark.simulation
def test_a_run_is_recorded(tmp_path):
    path = tmp_path / "run.mcap"
    done = studio("run", EXAMPLE, "--duration", "2", "--record", path)
    assert (done.returncode, done.stderr) == (0, "")
    found = recorded(path)
    assert {"/bt/tree", "/bt/tick", "/bt/log", "/world/scene", "/world/poses", "/scan"} <= found.keys()
    assert {"/bt/keyframe", "/odom", "/cmd_vel"} <= found.keys()
    assert found["/bt/tree"][0][1].name[0] == "bump and go"
    numbers = [tick.number for _, tick in found["/bt/tick"]]
    assert numbers[0] == 1
    assert numbers[-1] > 30
    assert sorted(set(numbers)) == list(range(1, numbers[-1] + 1))
    assert all(tick.fingerprint for _, tick in found["/bt/tick"])
    assert list(tmp_path.iterdir()) == [path]
    with path.open("rb") as file:
        (about,) = make_reader(file).iter_metadata()
    assert about.metadata["project"] == "Laser bump and go"
    assert any("The way is free" in line.text for _, line in found["/bt/log"])


@pytest.mark.simulation
def test_the_recording_of_a_killed_run_is_completed_by_convert(tmp_path):
    path = tmp_path / "run.mcap"
    parts = tmp_path / "run.mcap.parts"
    command = [*STUDIO, "run", str(EXAMPLE), "--record", str(path)]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL) as run:
        end_s = time.monotonic() + 60
        so_far = tmp_path / "so far.mcap"
        while not (parts.is_dir() and join_newest(parts, so_far) and "/bt/tick" in recorded(so_far)):
            assert time.monotonic() < end_s
            time.sleep(0.05)
        run.kill()
    again = studio("run", EXAMPLE, "--record", path)
    assert again.returncode == 1
    assert "holds what a killed run recorded" in again.stderr
    assert studio("convert", f"{path}.parts", "-o", path).returncode == 0
    assert {"/bt/tree", "/bt/tick", "/world/scene"} <= recorded(path).keys()


@pytest.mark.simulation
def test_a_run_in_lockstep_is_recorded_the_same_each_time(tmp_path):
    options = ["--lockstep", "--duration", "6", "--record"]
    runs = []
    for name in ("a.mcap", "b.mcap"):
        done = studio("run", EXAMPLE, *options, tmp_path / name)
        assert (done.returncode, done.stderr) == (0, "")
        with (tmp_path / name).open("rb") as file:
            messages = make_reader(file).iter_messages()
            runs.append([(c.topic, m.log_time, m.data) for _, c, m in messages if c.topic != "/bt/tick"])
    assert runs[0] == runs[1]
    found = recorded(tmp_path / "a.mcap")
    own = {"/bt/tree", "/bt/tick", "/bt/keyframe", "/world/scene", "/world/poses"}
    assert own | {"/scan", "/odom", "/imu", "/cmd_vel", "/joint_states"} <= found.keys()
    assert len(found["/scan"]) >= 60
    # The first is the tree at the beginning; the others have the world, too.
    assert [time_ns // 10**9 for time_ns, _ in found["/bt/keyframe"]] == [0, 0, 5]
    assert [bool(message.world.size) for _, message in found["/bt/keyframe"]] == [False, True, True]
    prints = [
        [message.fingerprint for _, message in recorded(tmp_path / n)["/bt/tick"]]
        for n in ("a.mcap", "b.mcap")
    ]
    assert prints[0] == prints[1]
    # The last message is that of the halt after the last tick.
    assert [tick.number for _, tick in found["/bt/tick"]] == [*range(1, 121), 120]


def test_a_recording_that_cannot_be_written_is_reported(tmp_path):
    done = studio("run", EXAMPLE, "--lockstep", "--record", tmp_path / "missing" / "run.mcap")
    assert done.returncode == 1
    assert "run.mcap: cannot be written: No such file or directory" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--lockstep", "--universe", "none"], "needs a simulated world"),
        (["--record", "run.jsonl"], "'run.jsonl' must end with .mcap"),
    ],
)
def test_what_lockstep_cannot_do_is_said_at_once(arguments, text):
    done = studio("run", EXAMPLE, *arguments)
    assert done.returncode == 2
    assert text in " ".join(done.stderr.replace("│", " ").split())


HANGS = {
    "sleeps": "time.sleep(600)",
    "catches all": "exec('while True:\\n try:\\n  time.sleep(600)\\n except BaseException: pass')",
    "holds the interpreter": "re.match(r'(a+)+$', 'a' * 60 + 'b')",
}
# The hardest in lock-step, and a plain one in real time, come first.
WAYS = [
    ("--lockstep", HANGS["holds the interpreter"]),
    ("", HANGS["sleeps"]),
    ("--lockstep", HANGS["sleeps"]),
    ("--lockstep", HANGS["catches all"]),
]


@pytest.mark.simulation
@pytest.mark.parametrize(("how", "body"), WAYS[: count("hangs_cli")])
def test_a_run_whose_action_hangs_ends_and_says_where(tmp_path, how, body):
    project = tmp_path / "project"
    shutil.copytree(EXAMPLE, project)
    action = project / "actions" / "Forward.py"
    action.write_text(action.read_text().replace("twist = Twist()", f"import re, time; {body}", 1))
    line = 1 + next(i for i, text in enumerate(action.read_text().split("\n")) if "import re" in text)
    done = studio("run", project, *filter(None, [how]), "--duration", "20")
    assert done.returncode == 1
    assert re.search(rf"^actions/Forward\.py:{line}:1: timeout .*Forward", done.stderr, re.MULTILINE), (
        done.stderr
    )
    assert "Traceback" not in done.stderr
