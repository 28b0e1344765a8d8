"""Faults: when they happen, what they name, and what the topics of a run then carry."""

import json
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from mcap.reader import make_reader

from executor.evaluation.document import Fault
from executor.evaluation.faults import nodes_named, schedule, topics_of
from executor.evaluation.plan import make_plan
from executor.robots.config import load_robot
from executor.universes.document import DocumentError
from tests.executor.evaluation.projects import DRIVE, WORLD, project, write

ROOT = Path(__file__).parents[3]
HEAD = """duration_s: 4
runs: 2
judge: {success: [{never: {closer_than_m: 0}}], measure: [path_length_m]}
faults:
"""
SEES = DRIVE.replace(
    "        self.publisher = ",
    """        from sensor_msgs.msg import Image, Imu, LaserScan
        self.heard = [
            node.create_subscription(LaserScan, "/scan", lambda m: None, 10),
            node.create_subscription(Imu, "/imu", lambda m: None, 10),
        ]
        self.publisher = """,
)


def fault(**fields):
    return Fault.model_validate(fields)


def test_faults_are_drawn_by_what_they_are():
    silent = fault(kind="sensor_silent", sensor="scan", at_s=[1, 5], for_s=[1, 2], probability=0.5)
    frozen = fault(kind="sensor_frozen", sensor="scan", at_s=[1, 5])
    alone = [schedule([silent], seed) for seed in range(200)]
    assert 70 < sum(map(len, alone)) < 130
    both = [schedule([frozen, silent], seed) for seed in range(200)]
    assert [[each for each in found if each.fault is silent] for found in both] == alone
    happened = next(found[0] for found in alone if found)
    assert 1 <= happened.at_s <= 5
    assert 1 <= happened.until_s - happened.at_s <= 2
    twice = schedule([frozen, frozen], 1)
    assert [each.address for each in twice] == ["faults.sensor_frozen.scan", "faults.sensor_frozen.scan#2"]
    assert twice[0].at_s != twice[1].at_s


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{kind: sensor_silent, sensor: scann}", "no sensor 'scann' (did you mean 'scan'?)"),
        ("{kind: sensor_noise, sensor: bumper, factor: 2}", "'bumper' has no noise to multiply"),
        (
            "{kind: topic_drop, topic: /scann, share: 1}",
            "'/scann' is not a topic of the robot (did you mean '/scan'?)",
        ),
        ("{kind: wheel_stuck, wheel: left}", "no wheel 'left'"),
        ("{kind: kidnap, area: nowhere}", "no area 'nowhere'"),
        ("{kind: action_raises, node: Drivee}", "names no action"),
        ("{kind: push, impulse_n_s: 1, direction: [1, 0], robot: other}", "no robot 'other'"),
    ],
)
def test_what_a_fault_names_must_exist(text, words):
    with pytest.raises(DocumentError) as caught:
        make_plan(project(HEAD + f"  - {text}\n"), "main")
    assert words in str(caught.value)
    assert str(caught.value).startswith("evaluations/main.yaml:7:")


def test_names():
    assert nodes_named(project(HEAD + "  - {kind: action_raises, node: go}\n"), "MainTree.a") == [
        ("MainTree", "a")
    ]
    assert "/scan" in topics_of(load_robot("turtle2"), {})
    assert "/laser" in topics_of(load_robot("turtle2"), {"scan": "/laser"})


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    """Runs faults in a process of its own, and returns the outcome with the messages of the recording."""
    process = subprocess.Popen(
        [sys.executable, "-m", "tests.executor.evaluation.cells"],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )

    def ask(faults, action=SEES, evaluation=HEAD, **others):
        folder = tmp_path_factory.mktemp("faults")
        listed = "".join(f"  - {each}\n" for each in faults) or "  []\n"
        write(folder / "p", evaluation + listed, action=action, **others)
        target = folder / "run.mcap"
        job = {"folder": str(folder / "p"), "seed": 1, "recording": str(target)}
        process.stdin.write(json.dumps(job) + "\n")
        process.stdin.flush()
        found = json.loads(process.stdout.readline())
        messages: dict[str, list[tuple[float, bytes]]] = {}
        with target.open("rb") as file:
            for _, channel, message in make_reader(file).iter_messages():
                at_s = message.log_time / 1e9
                if at_s <= found["end_s"]:  # a recording continues for a second after the decision
                    messages.setdefault(channel.topic, []).append((at_s, message.data))
        return found, messages

    with process:
        yield ask


def between(messages, topic, start_s, end_s):
    return [data for at_s, data in messages[topic] if start_s < at_s < end_s]


@pytest.mark.simulation
@pytest.mark.timeout(300)
def test_silent_frozen_dropped_and_delayed_sensors(record):
    found, messages = record(["{kind: sensor_silent, sensor: scan, at_s: 1, for_s: 1}"])
    assert found["faults"] == [{"fault": "faults.sensor_silent.scan", "at_s": 1.0, "until_s": 2.0}]
    assert [len(between(messages, "/scan", *each)) for each in ((0, 1), (1.01, 2), (2.01, 3))] == [9, 0, 9]
    _, messages = record(["{kind: sensor_frozen, sensor: scan, at_s: 1, for_s: 1}"])
    during = between(messages, "/scan", 1.01, 2)
    assert len(during) == 9
    assert len(set(during)) == 1
    assert len(set(between(messages, "/scan", 2.01, 3))) == 9
    _, messages = record(["{kind: topic_drop, topic: /scan, share: 0.5}"])
    assert 8 < len(messages["/scan"]) < 32  # of 40
    _, plain = record([])
    _, late = record(["{kind: topic_delay, topic: /scan, delay_s: 0.5}"])
    assert late["/scan"][0][0] == pytest.approx(plain["/scan"][0][0] + 0.5, abs=0.02)
    assert [data for _, data in late["/scan"]][:20] == [data for _, data in plain["/scan"]][:20]


@pytest.mark.simulation
@pytest.mark.timeout(300)
def test_noise_and_commands(record):
    _, plain = record([])
    _, noisy = record(["{kind: sensor_noise, sensor: scan, factor: 20, at_s: 1}"])
    assert between(noisy, "/scan", 0, 1) == between(plain, "/scan", 0, 1)
    assert between(noisy, "/scan", 1.01, 2)[0] != between(plain, "/scan", 1.01, 2)[0]
    still, _ = record(["{kind: topic_drop, topic: /cmd_vel, share: 1}"])
    assert still["measures"]["path_length_m"] < 0.01
    late, _ = record(["{kind: topic_delay, topic: /cmd_vel, delay_s: 2}"])
    moving, _ = record([])
    assert late["measures"]["path_length_m"] == pytest.approx(
        moving["measures"]["path_length_m"] - 1, abs=0.1
    )


@pytest.mark.simulation
@pytest.mark.timeout(300)
def test_wheels_pushes_and_kidnaps(record):
    stuck, _ = record(["{kind: wheel_stuck, wheel: wheel_left_joint, at_s: 1, for_s: 1}"])
    assert abs(stuck["path"][-1][2]) > 0.3  # it has turned, and left its line
    slip, _ = record(["{kind: wheel_slip, wheel: wheel_left_joint, factor: 0}"])
    assert abs(slip["path"][-1][2]) > 0.05
    pushed, _ = record(["{kind: push, impulse_n_s: 8, direction: [0, 1], at_s: 1}"])
    assert abs(pushed["path"][-1][2]) > 0.02
    straight, _ = record([])
    assert abs(straight["path"][-1][2]) < 0.01
    moved, _ = record(["{kind: kidnap, pose: [-3, 4, 0, 0, 0, 0], at_s: 2}"])
    assert moved["path"][-1][1:] == pytest.approx([-2, 4], abs=0.2)
    somewhere, _ = record(["{kind: kidnap, area: behind, at_s: 3.9}"])
    x, y = somewhere["path"][-1][1:]
    assert -3.2 < x < -1.3
    assert -1.2 < y < 1.2


@pytest.mark.simulation
@pytest.mark.timeout(300)
def test_a_kidnap_without_a_free_place_has_not_happened(record):
    world = WORLD.replace("areas:\n", "areas:\n  full: {box: [2.95, -1, 3.05, 1]}\n")
    fault = ["{kind: kidnap, area: full, at_s: 0.5}"]
    found, _ = record(
        fault, evaluation=HEAD.replace("duration_s: 4", "duration_s: 1"), **{"universes/yard.yaml": world}
    )
    assert (found["outcome"], found["faults"]) == ("success", [])
    assert found["path"][-1][1] < 1


@pytest.mark.simulation
@pytest.mark.timeout(300)
def test_actions_that_raise_and_lights(record):
    raised, _ = record(["{kind: action_raises, node: go, at_s: 2}"])
    assert (raised["outcome"], raised["end_s"]) == ("error", 2.0)
    assert "a fault of the evaluation makes this action raise" in raised["why"]
    eye = 'self.eye = node.create_subscription(Image, "/camera/image_raw", lambda m: None, 10)'
    camera = SEES.replace("self.publisher = ", f"{eye}\n        self.publisher = ", 1)
    short = HEAD.replace("duration_s: 4", "duration_s: 1")
    _, dark = record(["{kind: light_change, factor: 0.1, at_s: 0.5}"], camera, short)
    pictures = "/camera/image_raw/compressed"
    before, after = between(dark, pictures, 0, 0.5)[-1], between(dark, pictures, 0.6, 1)[-1]
    assert brightness(after) < 0.9 * brightness(before)


def brightness(message):
    jpeg = message[message.index(b"\xff\xd8") :]
    return cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR).mean()
