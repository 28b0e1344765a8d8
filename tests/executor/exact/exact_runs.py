"""Runs the process of an exact run directly, without a session, and gives it inputs."""

from __future__ import annotations

import base64
import os
import subprocess
import tempfile
import time
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from executor import child_messages
from executor.child_messages import ForWorld, StartApplication, StartWorld, decode_from_exact
from executor.manager.archive import unpack
from executor.manager.programs import session_programs
from executor.recorder.link import ADDRESS_VARIABLE
from executor.recorder_messages import BeginRun, StartRecorder, decode_from_recorder
from executor.supervision.channel import Channel, ChannelClosed, socket_pair
from tests.executor.forks import FORKS, Fork
from tests.executor.session_client import ROOT, app_zip
from translator import load, to_app_zip

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from executor.replay_messages import Input
    from executor.supervision.processes import Program

HASHING = """
        from hashlib import blake2b
        from nav_msgs.msg import Odometry
        from sensor_msgs.msg import LaserScan
        self.digest = blake2b(digest_size=8)
        self.number = 0
        node = self.own_node = kwargs["node"]
        for kind, topic in ((LaserScan, "/scan"), (Odometry, "/odom"), (Twist, "/cmd_vel")):
            node.create_subscription(kind, topic, self.digest.update, 10, raw=True)
        node.create_timer(0.37, lambda: self.digest.update(b"timer"))
"""
COUNTING = """
        import random
        self.number += 1
        self.digest.update(random.randbytes(4))
{}
        set_output(self, "hash", f"{self.number} {self.digest.hexdigest()}")
        twist.angular.z = random.uniform(-0.4, 0.4)
"""


def hashing_forward(more: str = "") -> str:
    """Returns the action *Forward*, which writes a hash of all that it hears to the blackboard."""
    source = (ROOT / "examples/laser_bump_and_go/actions/Forward.py").read_text()
    publisher = 'self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)\n'
    publish = "        self.publisher.publish(twist)\n"
    ports = '    INPUT_PORTS = {"lin_speed"'
    for old, new in (
        (publisher, publisher + HASHING.lstrip("\n")),
        (publish, COUNTING.lstrip("\n").replace("{}", more.rstrip("\n"), 1) + publish),
        ("Port, get_input", "Port, get_input, set_output"),
        (ports, '    OUTPUT_PORTS = {"hash": Port(str)}\n' + ports),
    ):
        assert old in source
        source = source.replace(old, new, 1)
    return source


def working_app(tick_work_s: float) -> str:
    """Returns the app of *Laser bump and go* whose action *Forward* computes for so long in each tick."""
    source = (ROOT / "examples/laser_bump_and_go/actions/Forward.py").read_text()
    begin = "    def update(self):\n"
    assert begin in source
    work = f"""        import time
        until_s = time.thread_time() + {tick_work_s}
        while time.thread_time() < until_s:
            pass
"""
    return app_zip(Forward=source.replace(begin, begin + work))


def hashing_app(more: str = "") -> str:
    """Returns the app of *Laser bump and go* with this action as base64."""
    folder = ROOT / "examples/laser_bump_and_go"
    files = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*.*")}
    files = {name: data for name, data in files.items() if "__pycache__" not in name}
    files["actions/Forward.py"] = hashing_forward(more).encode()
    tree = files["trees/MainTree.json"]
    files["trees/MainTree.json"] = tree.replace(
        b'{"lin_speed": "0.3"}', b'{"lin_speed": "0.3", "hash": "{hash}"}'
    )
    assert files["trees/MainTree.json"] != tree
    return base64.b64encode(to_app_zip(load(files))).decode()


@contextmanager
def app_folder(more: str = "") -> Iterator[Path]:
    """Unpacks this app."""
    with tempfile.TemporaryDirectory() as folder:
        unpack(hashing_app(more), Path(folder))
        yield Path(folder)


def start_message(
    folder: Path, seed: int = 3, universe: str = "walled_room", robot: str | None = None, **more: Any
) -> StartApplication:
    world = StartWorld(universe, robot=robot, seed=seed, speed=0.0)
    return StartApplication(str(folder), 20.0, on_finish="repeat", seed=seed, world=world, **more)


def _started(
    program: Program, decode: Any, *, is_fresh: bool
) -> tuple[subprocess.Popen[bytes] | Fork, Channel[Any, Any]]:
    ours, theirs = socket_pair()
    with theirs:
        if not is_fresh:
            environment = {**os.environ, **program.environment}
            files = (0, 1, 2, theirs.fileno())
            fork = FORKS.start(program.arguments[-1], ["--channel-fd", "3"], environment, *files)
            return fork, Channel(ours.detach(), decode)
        process = subprocess.Popen(
            [*program.arguments, "--channel-fd", str(theirs.fileno())],
            cwd=ROOT,
            env={**os.environ, **program.environment},
            pass_fds=[theirs.fileno()],
        )
    return process, Channel(ours.detach(), decode)


@dataclass
class ExactRun:
    """A process of an exact run, and what it said.

    The first run is a fresh process. One that is made again is the fork of a warm process, so it has other
    addresses.
    """

    start: StartApplication
    recordings: Path | None = None
    """The folder in which a recorder records the run; None for no recorder."""
    is_fresh: bool | None = None
    """Whether the process is a fresh one; None leaves that to whether the run is made again."""
    said: list[Any] = field(default_factory=list)
    inputs: list[Input] = field(default_factory=list)
    prints: bytearray = field(default_factory=bytearray)

    def __post_init__(self) -> None:
        programs = session_programs(3)
        program, environment = programs["exact"], dict(programs["exact"].environment)
        self._recorder: tuple[subprocess.Popen[bytes] | Fork, Channel[Any, Any]] | None = None
        is_fresh = self.start.replay is None if self.is_fresh is None else self.is_fresh
        if self.recordings is None:
            del environment[ADDRESS_VARIABLE]
        else:
            self._recorder = _started(programs["recorder"], decode_from_recorder, is_fresh=False)
            self._recorder[1].send(StartRecorder(str(self.recordings), is_whole=True))
        self.process, self.channel = _started(
            replace(program, environment=environment), decode_from_exact, is_fresh=is_fresh
        )
        self.channel.send(self.start)
        ends = (child_messages.ApplicationReady, child_messages.Fault, child_messages.TickSource)
        self.until(lambda m: isinstance(m, ends))
        if self._recorder is not None:
            self._recorder[1].send(BeginRun("a" * 12, {}, self.start.app_dir))
            self.tell(ForWorld(child_messages.BeginRecording("a" * 12)))
            self.tell(child_messages.BeginRecording("a" * 12))

    def tell(self, message: Any) -> None:
        self.channel.send(message)

    def until(self, condition: Callable[[Any], bool], timeout_s: float = 120) -> Any:
        """Returns the next message for which the condition holds."""
        deadline = time.monotonic() + timeout_s
        while time.monotonic() < deadline:
            message = self.channel.receive(0.5)
            if message is None:
                continue
            self._note(message)
            if condition(message):
                return message
        raise TimeoutError([type(message).__name__ for message in self.said[-20:]])

    def said_of(self, kind: type[Any]) -> list[Any]:
        return [message for message in self.said if isinstance(message, kind)]

    def resume(self) -> None:
        self.tell(child_messages.Resume())
        self.tell(ForWorld(child_messages.Resume()))

    def pause(self) -> None:
        self.tell(child_messages.Pause())
        self.tell(ForWorld(child_messages.Pause()))
        self.until(lambda m: isinstance(m, child_messages.Paused))

    def pause_after_tick(self) -> None:
        """Pauses just after a tick, where a run that is made again ends, too."""
        self.pause()
        self.tell(child_messages.StepTick())
        self.until(lambda m: isinstance(m, child_messages.Stepped))

    def run_ticks(self, count: int) -> None:
        """Runs until the run has reported so many more ticks, at least."""
        number = max((m.n for m in self.said_of(child_messages.Tick)), default=0)
        self.resume()
        self.until(lambda m: isinstance(m, child_messages.Tick) and m.n >= number + count)

    def end(self) -> bytes:
        """Ends the run, and returns the state of its world."""
        self.tell(child_messages.Stop())
        state = self.until(lambda m: isinstance(m, child_messages.WorldState))
        self.close()
        return bytes(state.data)

    def close(self) -> None:
        self.channel.close()
        if self._recorder is not None:
            process, channel = self._recorder
            channel.close()
            process.wait(30)
        if self.process.wait(30) < 0:
            raise AssertionError(self.process.returncode)

    def kill(self) -> None:
        self.process.kill()
        self.process.wait(30)
        try:
            while (message := self.channel.receive(0.5)) is not None:
                self._note(message)
        except ChannelClosed:
            pass
        self.channel.close()

    def _note(self, message: Any) -> None:
        self.said.append(message)
        if isinstance(message, child_messages.Entered):
            self.inputs.append(message.input)
        elif isinstance(message, child_messages.Fingerprints):
            self.prints += message.data
