"""A package whose tree has ROS blocks runs with rclpy and its own files; nothing of the studio is used."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import zipfile
from typing import TYPE_CHECKING, Any

import pytest

from tests.domains import own_domain_id
from tests.tree_gardener.programs import Peer
from translator import to_ros2_package

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

pytestmark = [
    pytest.mark.timeout(180),
    pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning"),
]

DOMAIN_ID = own_domain_id()
BLOCKS: dict[str, Any] = {
    "n1": {"type": "Sequence", "children": ["n2", "n3", "n4"]},
    "n2": {
        "type": "RosService",
        "ports": {
            "service_name": "/enable",
            "service_type": "std_srvs/srv/SetBool",
            "request__data": "true",
            "response__message": "{answer}",
            "wait_for_server_timeout": "-1",
        },
    },
    "n3": {
        "type": "RosPublish",
        "ports": {
            "topic_name": "/said",
            "topic_type": "std_msgs/msg/String",
            "message__data": "{answer}",
            "latched": "true",
        },
    },
    "n4": {
        "type": "RosSubscribe",
        "ports": {
            "topic_name": "/go",
            "topic_type": "std_msgs/msg/Bool",
            "mode": "wait",
            "condition": "data == true",
        },
    },
}
# As `ros2 run`: the package's folder and the engine's beside it, and an index that names the package's share.
START = """
import os
import pathlib
import sys

import ament_index_python.packages as index

here = pathlib.Path.cwd()
index.get_package_share_directory = lambda name: str(here / name)
sys.path[:0] = [str(here / NAME), str(here / "tree_gardener")]
main = __import__(NAME + ".main").main
status = getattr(main, sys.argv.pop(1))()
files = [getattr(module, "__file__", None) or "" for module in sys.modules.values()]
foreign = [file for file in files if file.startswith(STUDIO) and not file.startswith(sys.prefix)]
sys.exit(f"it used {foreign}" if foreign else status)
"""


@pytest.fixture
def package(make_project: Callable[..., Any], tmp_path: Path) -> Path:
    """The package, unzipped."""
    project = make_project(BLOCKS, actions={}, name="Outside", on_finish="stop")
    (tmp_path / "package.zip").write_bytes(to_ros2_package(project).to_zip())
    with zipfile.ZipFile(tmp_path / "package.zip") as archive:
        archive.extractall(tmp_path / "src")
    return tmp_path / "src"


@pytest.fixture
def peer() -> Iterator[Peer]:
    made = Peer(DOMAIN_ID)
    yield made
    made.close()


def start(package: Path, function: str) -> subprocess.Popen[str]:
    from pathlib import Path

    root = Path(__file__).resolve().parents[3]
    script = START.replace("NAME", json.dumps("outside")).replace("STUDIO", json.dumps(f"{root}/"))
    kept = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    return subprocess.Popen(
        [sys.executable, "-P", "-c", script, function],
        cwd=package,
        env={**kept, "ROS_DOMAIN_ID": str(DOMAIN_ID), "AMENT_PREFIX_PATH": sys.prefix},
        stderr=subprocess.PIPE,
        text=True,
    )


def answer(peer: Peer) -> list[str]:
    """Offers the service and the topics that the tree needs; returns the texts that it publishes."""
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from std_msgs.msg import Bool, String
    from std_srvs.srv import SetBool

    heard: list[str] = []

    def enable(request: Any, response: Any) -> Any:
        response.success = request.data
        response.message = "enabled"
        return response

    node = peer.node
    node.create_service(SetBool, "/enable", enable)
    quality = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(String, "/said", lambda message: heard.append(message.data), quality)
    go = node.create_publisher(Bool, "/go", 1)
    node.create_timer(0.1, lambda: go.publish(Bool(data=True)))
    return heard


def test_the_tree_runs_to_its_end(package: Path, peer: Peer) -> None:
    program = start(package, "main")
    try:
        heard = answer(peer)
        peer.until(lambda: program.poll() is not None)
    finally:
        program.kill()
        said = program.communicate(timeout=30)[1]
    assert program.returncode == 0, said
    assert "the tree ended with SUCCESS" in said
    assert "enabled" in heard


def test_the_server_runs_it_by_name(package: Path, peer: Peer) -> None:
    from btcpp_ros2_interfaces.action import ExecuteTree
    from rclpy.action import ActionClient

    program = start(package, "serve")
    try:
        answer(peer)
        client = ActionClient(peer.node, ExecuteTree, "bt_execution")
        peer.until(client.server_is_ready)
        handle = peer.answer(client.send_goal_async(ExecuteTree.Goal(target_tree="MainTree")))
        result = peer.answer(handle.get_result_async()).result
        client.destroy()
    finally:
        program.send_signal(signal.SIGINT)
        said = program.communicate(timeout=60)[1]
    assert result.return_message == "Tree finished with status: SUCCESS"
    assert program.returncode == 0, said
