"""The cost of Python breakpoints: the tick of the example, with debugpy and without, and what stays of it."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
from typing import Any

import msgspec

from executor.adapter_messages import AdapterText, FromAdapter, StartAdapter, ToAdapter, decode_from_adapter
from executor.application.host import enter
from executor.application.python.debugger import connect, trace
from executor.child_messages import ConnectDebugger
from executor.supervision.channel import Channel, socket_pair
from tests.benchmarks.engine import warm
from tests.benchmarks.timing import race

ROOT = pathlib.Path(__file__).parents[2]
EXAMPLE = ROOT / "examples/laser_bump_and_go"
TREE = """<root BTCPP_format="4"><BehaviorTree ID="Main"><ReactiveFallback>
<ReactiveSequence><Inverter><CheckObstacle obs_dist="1.0"/></Inverter>
<Forward lin_speed="0.3"/></ReactiveSequence>
<Turn ang_speed="0.6"/></ReactiveFallback></BehaviorTree><Code>{}</Code></root>"""
TOKEN = "benchmark"


class _Node:
    """The part of a ROS node that the example uses; messages go nowhere."""

    def __init__(self) -> None:
        self.hear: list[Any] = []

    def create_publisher(self, *_: Any) -> _Node:
        return self

    def publish(self, message: Any) -> None:
        pass

    def create_subscription(self, _kind: Any, _topic: str, callback: Any, _qos: Any) -> None:
        self.hear.append(callback)


class _Client:
    """A client of debugpy's adapter."""

    def __init__(self) -> None:
        ours, theirs = socket_pair()
        fd = theirs.fileno()
        command = [sys.executable, "-m", "executor.debug_adapter.process", "--channel-fd", str(fd)]
        self.process = subprocess.Popen(command, pass_fds=[fd], cwd=ROOT)
        theirs.close()
        self.channel: Channel[ToAdapter, FromAdapter] = Channel(ours.detach(), decode_from_adapter)
        self.channel.send(StartAdapter(TOKEN))
        self.seq = 0

    def send(self, command: str, **arguments: Any) -> int:
        self.seq += 1
        message = {"seq": self.seq, "type": "request", "command": command, "arguments": arguments}
        self.channel.send(AdapterText(msgspec.json.encode(message)))
        return self.seq

    def until(self, **wanted: Any) -> dict[str, Any]:
        while True:
            message = self.channel.receive(30)
            if not isinstance(message, AdapterText):
                raise TypeError(f"the adapter says {message!r}")
            told: dict[str, Any] = msgspec.json.decode(message.text)
            if told.items() >= wanted.items():
                return told

    def ask(self, command: str, **arguments: Any) -> dict[str, Any]:
        return self.until(request_seq=self.send(command, **arguments))


def _load(folder: pathlib.Path) -> Any:
    from sensor_msgs.msg import LaserScan

    from tree_gardener import Tree

    (folder / "actions").mkdir()
    code = []
    for file in sorted((EXAMPLE / "actions").glob("*.py")):
        source = file.read_text()
        (folder / "actions" / file.name).write_text(source)
        code.append(f"<Action name='{file.stem}'><![CDATA[{source}]]></Action>")
    enter(folder)
    tree, node = Tree.from_xml(TREE.format("".join(code))), _Node()
    tree.setup(node=node)
    scan = LaserScan(angle_min=-3.14, angle_increment=0.0174, range_min=0.1, range_max=10.0)
    scan.ranges = [3.0] * 360
    for hear in node.hear:
        hear(scan)
    return tree


def _configure(client: _Client) -> None:
    client.until(event="initialized")
    client.ask("configurationDone")


def measure() -> dict[str, float]:
    """Returns the µs of processor time of a tick, in the order in which the states follow each other."""
    found: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        with open(os.devnull, "w") as silence:  # noqa: PTH123 - a stream for prints
            sys.stdout, out = silence, sys.stdout
            try:
                _measure(folder, found)
            finally:
                sys.stdout = out
                os.chdir(ROOT)
    return found


def _measure(folder: pathlib.Path, found: dict[str, float]) -> None:
    tree = _load(folder)
    file = str(folder / "actions/CheckObstacle.py")

    def time(state: str) -> None:
        warm(tree.tick_exactly_once)
        [found[state]] = race(tree.tick_exactly_once, least_s=0.05, rounds=15)

    time("without debugpy")
    client = _Client()
    client.ask("initialize", adapterID="debugpy", pathFormat="path")
    client.send("attach", connect={"host": "127.0.0.1", "port": 0}, justMyCode=True, subProcess=False)
    port = client.until(event="debugpyWaitingForServer")["body"]["port"]
    done = threading.Thread(target=_configure, args=(client,))
    done.start()
    connect(ConnectDebugger(port, TOKEN), folder)
    done.join()
    time("connected, no breakpoint")
    line = {"line": 31}  # in `update`, where no scan is known
    client.ask("setBreakpoints", source={"path": file}, breakpoints=[line])
    time("a line that is not reached")
    client.ask("setBreakpoints", source={"path": file}, breakpoints=[{"line": 32, "condition": "False"}])
    time("a false condition in each tick")
    client.ask("setBreakpoints", source={"path": file}, breakpoints=[])
    time("the last breakpoint is gone")
    trace(is_on=False)
    time("and tracing has ended, as in a session")
    client.process.kill()
    client.process.wait()
    time("the debugger has ended")


def main(arguments: list[str] | None = None) -> None:
    """Prints the table. Measures in a process of its own, since debugpy cannot be unloaded."""
    if arguments is None:
        command = [sys.executable, "-m", "tests.benchmarks.python_debugger", "measure"]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
        times = json.loads(done.stdout.splitlines()[-1])
        first = next(iter(times.values()))
        print("Python breakpoints: a tick of the example, µs of processor time")
        for state, us in times.items():
            print(f"{state:32} {us:9.1f} ({us / first:5.2f}x)")
        return
    print(json.dumps(measure()))


if __name__ == "__main__":
    main(sys.argv[1:])
