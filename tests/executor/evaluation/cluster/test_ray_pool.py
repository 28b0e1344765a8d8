"""A Ray cluster has the outcomes of this machine's pool, also when a supervisor and a node are killed."""

import socket
import subprocess
import sys

import pytest

from executor.evaluation.cluster import ray_pool
from executor.evaluation.cluster.ray_pool import ClusterError, RayPool, connect, has_cluster, import_ray
from tests.budget import count
from tests.cli.typed import EVALUATING, ROOT, evaluating
from tests.executor.evaluation.projects import write

NODES = count("ray_nodes")
SEEDS = 3 if NODES < 2 else 24
TEXT = f"""duration_s: {2 if NODES < 2 else 8}
runs: {SEEDS}
vary: {{robot.pose: {{area: start, yaw: [-0.4, 0.4]}}}}
judge: {{success: [{{reach: {{area: ahead}}}}, {{never: collision}}]}}
"""


@pytest.mark.simulation
@pytest.mark.timeout(900)
def test_a_cluster_has_the_outcomes_of_one_machine(tmp_path):
    folder, report = write(tmp_path / "p", TEXT), tmp_path / "r"
    evaluating("evaluate", folder, "--workers", 1, "--report", report).check_returncode()
    done = subprocess.run(
        [sys.executable, "-m", "tests.executor.evaluation.cluster.nodes", folder, str(SEEDS), str(NODES)],
        cwd=ROOT,
        env=EVALUATING,
        check=False,
        capture_output=True,
        text=True,
        timeout=800,
    )
    assert done.returncode == 0, done.stderr[-3000:]
    found = [line for line in done.stdout.splitlines() if line.startswith("{")]  # Ray reports too
    assert found == (report / "runs.jsonl").read_text().splitlines()


def test_a_missing_extra_is_one_sentence_with_the_command(monkeypatch):
    monkeypatch.setitem(sys.modules, "ray", None)  # as if it were not installed
    with pytest.raises(
        ClusterError, match=r"needs Ray, which is not installed: .* -m pip install 'ray~="
    ) as found:
        import_ray(is_own=False)
    assert "\n" not in str(found.value)
    with pytest.raises(ClusterError, match="needs Ray"):
        RayPool(b"", "127.0.0.1:1", first_limit_s=1.0, scale=lambda _: 1.0)


def test_a_cluster_is_known_by_what_ray_notes(monkeypatch, tmp_path):
    monkeypatch.delenv("RAY_ADDRESS", raising=False)
    monkeypatch.setattr(ray_pool, "NOTED", tmp_path / "ray_current_cluster")
    assert not has_cluster()
    (tmp_path / "ray_current_cluster").touch()
    assert has_cluster()
    monkeypatch.setattr(ray_pool, "NOTED", tmp_path / "nothing")
    monkeypatch.setenv("RAY_ADDRESS", "10.0.0.1:6379")
    assert has_cluster()


class RayWithoutCluster:
    """Ray where nothing answers at the address."""

    def init(self, **_: object) -> None:
        raise ConnectionError("nothing answers\nat all")

    def shutdown(self) -> None:
        raise AssertionError("a cluster that is not there is not tried again")


class RayOfASlowMachine:
    """Ray whose node starts late a few times, and then in time."""

    def __init__(self, late: int) -> None:
        self.late, self.shutdowns = late, 0

    def init(self, **_: object) -> None:
        if self.late:
            self.late -= 1
            raise Exception("The current node timed out during startup. This could happen because …")

    def shutdown(self) -> None:
        self.shutdowns += 1


def test_a_node_that_is_late_is_started_again_and_at_last_said():
    ray = RayOfASlowMachine(late=3)
    connect(ray, None)
    assert ray.shutdowns == 3
    with pytest.raises(ClusterError, match="timed out during startup"):
        connect(RayOfASlowMachine(late=99), None)


def test_a_note_of_a_cluster_that_is_gone_is_named(monkeypatch, tmp_path):
    noted = tmp_path / "ray_current_cluster"
    monkeypatch.setattr(ray_pool, "NOTED", noted)
    with pytest.raises(ClusterError, match=r"^--cluster auto: there is no Ray cluster: nothing answers$"):
        connect(RayWithoutCluster(), "auto")
    noted.touch()
    with pytest.raises(ClusterError, match="`ray stop` removes that note"):
        connect(RayWithoutCluster(), "auto")


def test_an_address_at_which_nothing_answers_is_named_before_ray_tries_for_a_minute():
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        with pytest.raises(ClusterError, match="there is no Ray cluster"):  # Ray was asked
            connect(RayWithoutCluster(), f"127.0.0.1:{port}")
    for address in (f"127.0.0.1:{port}", f"ray://127.0.0.1:{port}", f"no-such-host.invalid:{port}"):
        with pytest.raises(ClusterError, match=f"^--cluster {address}: nothing answers there"):
            connect(RayWithoutCluster(), address)
