"""A tree file run as a node, as exported packages do: its parameters, and errors about wrong ones."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import pytest

from tests.tree_gardener.debugging.hooked import free_port, hook_of
from tests.tree_gardener.groot.zmtp import Groot2
from tree_gardener import Status
from tree_gardener.debugging import Force
from tree_gardener.ros_main import manage_tree, run_tree, serve_trees

ROOT = Path(__file__).resolve().parents[2]

os.environ.setdefault("ROS_DOMAIN_ID", "11")
os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

# One of rclpy's own dependencies uses it.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

TREE = '<root BTCPP_format="4"><BehaviorTree ID="T"><Note/></BehaviorTree></root>'
NOTE = """
import json
import pathlib

import py_trees


class Note(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        node = kwargs["node"]
        node.declare_parameter("gain", 2.0)
        names = ("tick_hz", "on_finish", "on_error", "use_sim_time", "gain")
        values = {name: node.get_parameter(name).value for name in names}
        result = node.set_parameters([type(node.get_parameter("tick_hz"))("tick_hz", value=1.0)])
        values["settable"] = result[0].successful
        pathlib.Path("FOLDER/values.json").write_text(json.dumps(values))

    def update(self):
        return py_trees.common.Status.SUCCESS
"""


@pytest.fixture
def run(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> Any:
    """Runs the tree with a file of parameters and words; gives status, values seen, and what was said."""
    (tmp_path / "tree.xml").write_text(TREE)
    (tmp_path / "actions").mkdir()
    (tmp_path / "actions" / "Note.py").write_text(NOTE.replace("FOLDER", str(tmp_path)))

    def ran(parameters: str, *words: str, **defaults: Any) -> tuple[int, Any, str]:
        tree = (tmp_path / "tree.xml").read_text()
        (tmp_path / "tree.xml").write_text(
            tree.replace("</root>", '<Code><Action name="Note"/></Code></root>')
        )
        (tmp_path / "params.yaml").write_text(parameters)
        args = [*words, "--ros-args", "--params-file", str(tmp_path / "params.yaml")]
        status = run_tree(
            tmp_path / "tree.xml", node_name="noting", actions=tmp_path / "actions", args=args, **defaults
        )
        values = tmp_path / "values.json"
        return status, json.loads(values.read_text()) if values.is_file() else None, capfd.readouterr().err

    return ran


def under(header: str, **values: str) -> str:
    return f"{header}:\n  ros__parameters:\n" + "".join(f"    {k}: {v}\n" for k, v in values.items())


@pytest.mark.parametrize(
    ("program", "said"),
    [
        (run_tree, ["--tick_hz=…", "(default: 5.0)", "--on_finish=…", "until it ends"]),
        (serve_trees, ["--on_new_goal=…", "'preempt'", "by name, as the server"]),
        (manage_tree, ["--on_error=…", "as a lifecycle node"]),
    ],
)
@pytest.mark.parametrize("word", ["--help", "-h"])
def test_help_is_printed_and_nothing_runs(
    program: Any, said: list[str], word: str, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [word, "--ros-args", "-p", "tick_hz:=1.0"]
    assert program("missing.xml", node_name="patrol", tick_hz=5.0, args=words) == 0
    out, err = capsys.readouterr()
    assert out.startswith("patrol: ")
    assert err == ""
    for text in (*said, "--tree=…", "missing.xml", "--use_sim_time=…", "--ros-args"):
        assert text in out


def test_what_is_not_given_is_what_the_package_says(run: Any) -> None:
    status, values, _ = run(under("/**", gain="0.5"), tick_hz=50.0, on_error="failure")
    assert status == 0
    assert values == {
        "tick_hz": 50.0,
        "on_finish": "stop",
        "on_error": "failure",
        "use_sim_time": False,
        "gain": 0.5,
        "settable": False,
    }


def test_groot2_follows_and_ends_a_run(run: Any, tmp_path: Path) -> None:
    endless = "<Sequence><Note/><Sleep msec='600000'/></Sequence>"
    (tmp_path / "tree.xml").write_text(TREE.replace("<Note/>", endless))
    port = free_port()

    def end() -> None:
        client = Groot2.as_soon_as_served(port)
        client.insert_hooks([hook_of(Force(3, Status.SUCCESS), 0)])
        client.close()

    client = threading.Thread(target=end)
    client.start()
    status, _, said = run(under("/**", groot2_port=str(port), tick_hz="50"))
    client.join()
    assert status == 0
    assert f"Groot2 can follow the tree at 127.0.0.1:{port}" in said


def test_a_tree_runs_without_groot2_where_its_port_is_taken(run: Any) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        status, _, said = run(under("/**", gain="1.0"), f"--groot2_port={port}")
    assert status == 0
    assert f"Groot2 cannot follow the tree: Groot2 needs the ports {port}" in said


@pytest.mark.parametrize("header", ["/**", "/noting", "noting", "/*"])
def test_a_file_of_parameters_goes_before_that(run: Any, header: str) -> None:
    _, values, _ = run(under(header, tick_hz="40", on_error="failure"), tick_hz=50.0)
    assert (values["tick_hz"], values["on_error"]) == (40, "failure")


@pytest.mark.parametrize("header", ["/**", "/noting"])
def test_an_argument_goes_before_the_file_whatever_its_sections_and_types(run: Any, header: str) -> None:
    file = under(header, tick_hz="40", on_error="failure") + under("/**/noting", tick_hz="41")
    _, values, _ = run(file, "--tick_hz=33.5", "--on_error=stop")
    assert (values["tick_hz"], values["on_error"]) == (33.5, "stop")


@pytest.mark.parametrize(
    ("file", "words", "said"),
    [
        (
            under("/**", tick_hz="fast"),
            [],
            "tick_hz is 'fast', but has to be a number above 0 (FILE, line 3)",
        ),
        (under("/**", gain="1.0"), ["--groot2_port=70000"], "groot2_port is 70000, but has to be a port"),
        (under("/**", groot2_port="high"), [], "groot2_port is 'high', but has to be a port"),
        (
            under("/**", cmd_timeout_s="-1"),
            [],
            "cmd_timeout_s is -1, but has to be a number of seconds, or 0",
        ),
        (under("/**", cmd_timeout_s="soon"), [], "cmd_timeout_s is 'soon', but has to be a number"),
        (under("/**", groot2_host="7"), [], "groot2_host is 7, but has to be an address"),
        (under("/**", tick_hz="true"), [], "tick_hz is true, but has to be a number above 0 (FILE, line 3)"),
        (under("/**", tick_hz="0"), [], "tick_hz is 0, but"),
        (under("/**", tick_hz=".inf"), [], "tick_hz is inf, but"),
        (under("/**", tick_hz="[1.0]"), [], "but has to be a number above 0 (FILE, line 3)"),
        (under("/**", on_finish="never"), [], "on_finish is 'never', but has to be stop or repeat (FILE"),
        (under("/**", on_error="off"), [], "on_error is false, but has to be stop or failure (FILE"),
        (under("/**", tree="7"), [], "tree is 7, but has to be the path of a file (FILE, line 3)"),
        (under("/**", tree="/none.xml"), [], "/none.xml cannot be read: No such file"),
        (
            under("/**", use_sim_time="'yes'"),
            [],
            "use_sim_time has to be true or false, without quotes (FILE",
        ),
        (under("/**", gain="high"), [], "'gain' to 'high'"),
        ("tick_hz: 1\n", [], "the node cannot start: failed to initialize rcl: Couldn't parse params file"),
        ("a: [", [], "Couldn't parse params file"),
        ("", ["--tick_hz=fast"], "tick_hz is 'fast', but has to be a number above 0 (an argument)"),
        ("", ["--on_finish="], "on_finish is '', but has to be stop or repeat (an argument)"),
        ("", ["--use_sim_time=yes"], "--use_sim_time=yes has to be true or false"),
        ("", ["--tick_rate=5"], "the argument '--tick_rate=5' is not known; there are --tree=…, --tick_hz=…"),
        ("", ["tick_hz"], "the argument 'tick_hz' is not known"),
    ],
)
def test_a_wrong_parameter_is_said_with_its_place(
    run: Any, tmp_path: Path, file: str, words: list[str], said: str
) -> None:
    status, _, err = run(file, *words)
    assert status == 1
    assert said.replace("FILE", str(tmp_path / "params.yaml")) in err
    # If an action raised an exception, its lines help its author.
    assert "Traceback" not in err or "gain" in said


def test_simulated_time_that_does_not_come_is_said(tmp_path: Path) -> None:
    (tmp_path / "tree.xml").write_text(TREE.replace("Note", "AlwaysSuccess"))
    script = (
        "import sys; from tree_gardener import ros_main, ros_spinning; ros_spinning.CLOCK_S = 0.2;"
        "sys.exit(ros_main.run_tree('tree.xml', node_name='waiting'))"
    )
    program = subprocess.Popen(
        [sys.executable, "-c", script, "--use_sim_time=true"],
        cwd=tmp_path,
        env={**os.environ, "ROS_DOMAIN_ID": "12", "PYTHONPATH": str(ROOT)},
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert program.stderr is not None
        heard = next((line for line in program.stderr if "/clock" in line), "")
        assert "use_sim_time is true, but no time came on /clock" in heard
    finally:
        program.send_signal(signal.SIGINT)
        program.communicate(timeout=60)
    assert program.returncode == 0
