"""Sealed runs: honest actions have the outcomes of unsealed runs, and others get hold of nothing."""

import os
import socket
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

from executor.evaluation.sealed.run import environment
from executor.supervision.single_threaded import SINGLE_THREADED
from tests.budget import count
from tests.executor.evaluation.one_by_one import CELLS, Cells
from tests.executor.evaluation.projects import DRIVE, write
from tests.executor.evaluation.sealed.attacks import BROWSES, FORKS, LEAVES, WRITES, action
from tests.executor.evaluation.sealed.launchers import LAUNCHERS, SHOWN, STARTED, TO_SHOW

ROOT = Path(__file__).parents[4]
SEEDS = count("sealed_runs")
pytestmark = [pytest.mark.simulation, pytest.mark.timeout(1800 if SEEDS < 20 else 7200)]
HEAD = "duration_s: 2\nruns: 2\n"
JUDGE = f"{HEAD}judge: {{success: [{{reach: {{area: ahead}}}}]}}\n"
STAMPED = DRIVE.replace("twist = Twist()", "twist = TwistStamped()").replace(
    "twist.linear", "twist.twist.linear"
)
STAMPED = STAMPED.replace("import Twist", "import TwistStamped").replace("(Twist,", "(TwistStamped,")
DRAWS = DRIVE.replace("import py_trees\n", "import random\n\nimport py_trees\n").replace(
    "twist.linear.x = ", "twist.angular.z = random.uniform(-1, 1)\n        twist.linear.x = "
)
WAITS = DRIVE.replace("self.publisher = ", "self.node = node\n        self.publisher = ").replace(
    "        self.publisher.publish(twist)\n",
    """        self.publisher.publish(twist)
        import rclpy
        rclpy.spin_until_future_complete(self.node, rclpy.task.Future(), timeout_sec=0.33)
""",
)
NAVIGATES = DRIVE.replace(
    "self.publisher = ",
    """from nav2_msgs.action import NavigateToPose
        from rclpy.action import ActionClient
        self.client = ActionClient(node, NavigateToPose, "/navigate_to_pose")
        self.publisher = """,
)
FAULTS = """vary: {ports.MainTree.go.speed: [0.1, 0.5], robot.pose: {area: start, yaw: [0, 6.283]}}
faults:
  - {kind: topic_drop, topic: /cmd_vel, share: 0.5, at_s: 0.5, for_s: 1}
  - {kind: action_raises, node: go, at_s: 1.5, probability: 0.5}
"""


@contextmanager
def cells_of(launcher, folder):
    """Yields a process of `cells` as a launcher starts it, and where it has the folder."""
    folder.chmod(0o755)
    command = (sys.executable, "-m", "tests.executor.evaluation.sealed.launchers", launcher, *CELLS)
    with Cells({**os.environ, **SINGLE_THREADED, SHOWN: str(folder)}, command) as started:
        yield started, folder if launcher == "root" or os.getuid() != 0 else TO_SHOW


@pytest.fixture(scope="module")
def cells():
    with Cells({**os.environ, **SINGLE_THREADED}) as found:
        yield found


@pytest.mark.parametrize(
    ("example", "name"), [("laser_bump_and_go", "room"), ("visual_follow_person", "follow")]
)
def test_sealed_equals_unsealed_for_the_examples(example, name, cells):
    options = {} if SEEDS >= 20 else {"duration_s": 8}
    for seed in range(2, 2 + SEEDS):
        job = {"folder": ROOT / "examples" / example, "name": name, "seed": seed, **options}
        assert cells(**job, sealed=True).to_line() == cells(**job).to_line()


@pytest.mark.parametrize("source", [STAMPED, DRAWS, WAITS], ids=["stamped", "draws", "waits"])
def test_sealed_equals_unsealed_with_faults_and_waits(source, tmp_path, cells):
    folder = write(tmp_path, f"{HEAD}{FAULTS}judge: {{success: [{{never: collision}}]}}\n", action=source)
    found = cells(folder, seed=1)
    assert found.seen
    assert cells(folder, seed=1, sealed=True).to_line() == found.to_line()


@pytest.mark.parametrize("launcher", STARTED)
def test_sealed_equals_unsealed_for_each_launcher(launcher, tmp_path):
    folder = write(tmp_path, f"{HEAD}{FAULTS}judge: {{success: [{{never: collision}}]}}\n", action=WAITS)
    with cells_of(launcher, folder) as (started, shown):
        found = started(shown, seed=1)
        assert found.seen
        assert started(shown, seed=1, sealed=True).to_line() == found.to_line()


@pytest.mark.parametrize("launcher", LAUNCHERS[:3:2])  # with and without a namespace of processes
def test_what_an_action_starts_does_not_hold_the_link(launcher, tmp_path):
    with cells_of(launcher, write(tmp_path, JUDGE, action=action(FORKS))) as (started, shown):
        found = started(shown, sealed=True)
    assert (found.outcome, found.why) == (
        "crashed",
        "the process of the actions ended by itself with status 3",
    )


def test_errors_have_the_same_places(tmp_path, cells):
    for number, source in enumerate(
        (
            DRIVE.replace("twist = Twist()", "raise ValueError('no way')"),
            DRIVE.replace("self.publisher = ", "self.publisher = nothing = 1 / 0 or "),
            "__import__('nothing_here')\n" + DRIVE,
        )
    ):
        folder = write(tmp_path / str(number), JUDGE, action=source)
        found = cells(folder)
        assert found.outcome == "error"
        assert cells(folder, sealed=True).to_line() == found.to_line()


def test_nothing_of_the_judge_is_in_reach_of_the_actions(tmp_path, cells):
    with socket.create_server(("127.0.0.1", 0)) as server:
        hidden, port = tmp_path / "evaluations" / "main.yaml", server.getsockname()[1]
        values = {"hidden": str(hidden), "port": port, "other": os.getpid()}
        folder = write(tmp_path, JUDGE, action=action(BROWSES, **values))
        found = cells(folder, sealed=True)
        assert (found.outcome, found.why.partition("RuntimeError: ")[2]) == ("error", "got: ")
        assert not (tmp_path / "evaluations" / "left").exists()
        # The same attempts succeed without a seal, so the test can tell.
        got = cells(folder).why
    for name in ("the world", "/proc", "hidden files", "written files", "signals", "the network"):
        assert name in got


def test_written_descriptors_forge_nothing(tmp_path, cells):
    found = cells(write(tmp_path, JUDGE, action=action(WRITES)), sealed=True)
    assert found.outcome == "crashed"
    assert "the process of the actions sent" in found.why


def test_an_action_that_leaves_decides_nothing(tmp_path, cells):
    found = cells(write(tmp_path, JUDGE, action=action(LEAVES)), sealed=True)
    assert (found.outcome, found.why) == (
        "crashed",
        "the process of the actions ended by itself with status 0",
    )


def test_navigation_is_refused_by_name(tmp_path, cells):
    found = cells(write(tmp_path, JUDGE, action=NAVIGATES), sealed=True)
    assert (found.outcome, found.why) == (
        "error",
        "a sealed run has no navigation, and the actions use /navigate_to_pose",
    )


def test_the_environment_names_nothing_of_the_run():
    given = {"PATH": "/bin", "BT_STUDIO_SEED": "3", "PWD": "/project", "ROS_DOMAIN_ID": "0", "SECRET": "x"}
    found = environment(given, Path("/scratch"))
    assert found.keys() & given.keys() == {"PATH", "ROS_DOMAIN_ID"}
    assert found["HOME"] == "/scratch"
