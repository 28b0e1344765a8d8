"""Programs of exported packages that drive a simulated robot, and everything that ends them.

Simulated time passes only when a command has come, and not while a program ends: so a busy machine changes
nothing.
"""

from __future__ import annotations

import contextlib
import signal
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from executor.universes import parse_universe
from executor.world.physics.bullet import BulletWorld
from tests.deadline import DEADLINE_S
from tests.tree_gardener.programs import Peer, program
from tree_gardener.ros_spinning import BROKEN, ENDED

if TYPE_CHECKING:
    import subprocess
    from collections.abc import Callable, Iterator
    from pathlib import Path

SPEED: Final = 0.2
STANDS_WITHIN_S: Final = 0.3
STANDS_M_S: Final = 0.005
STEPS: Final = 12
"""Of the world in a period of the ticks, 50 ms."""
AGAIN_S: Final = 0.2
GO: Final = """import pathlib
import sys
import threading

import py_trees
from geometry_msgs.msg import KIND, Twist
from py_trees.common import Status
from rclpy.action import ActionClient
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tf2_msgs.action import LookupTransform


def fail(*_):
    raise ValueError("no arm")


def is_time():
    return pathlib.Path("now").exists()


class Go(py_trees.behaviour.Behaviour):
    def setup(self, node):
        self.node = node
        self.publisher = node.create_publisher(KIND, "/cmd_vel", 10)
        self.SETUP

    def nothing(self):
        pass

    def subscribe(self):
        self.node.create_subscription(String, "/cause", fail, 10)

    def subscribe_apart(self):
        thread = threading.Thread(target=self.node.create_subscription, args=(String, "/cause", fail, 10))
        thread.start()
        thread.join()

    def serve(self):
        self.node.create_service(Trigger, "/cause", fail)

    def declare(self):
        self.node.declare_parameter("cause", 1.0)
        self.node.add_on_set_parameters_callback(fail)

    def time(self):
        self.node.create_timer(0.01, lambda: is_time() and fail())

    def leave(self):
        self.node.create_timer(0.01, lambda: is_time() and sys.exit(7))

    def call(self):
        self.client = self.node.create_client(Trigger, "/theirs")

    def connect(self):
        self.client = ActionClient(self.node, LookupTransform, "/look")

    def update(self):
        message = KIND()
        getattr(message, "twist", message).linear.x = SPEED
        self.publisher.publish(message)
        if is_time():
            CAUSE
        return Status.RUNNING

    def call_once(self):
        client, self.client = self.client, None
        if client is not None:
            client.call_async(Trigger.Request()).add_done_callback(fail)

    def send_once(self):
        client, self.client = self.client, None
        if client is not None:
            self.kept = client
            client.send_goal_async(LookupTransform.Goal(), fail)
"""
XML: Final = (
    '<root BTCPP_format="4"><BehaviorTree ID="Main"><Go/></BehaviorTree>'
    '<Code><Action name="Go"/></Code></root>'
)
CODE: Final = {
    "the tree ends": ("nothing()", "return Status.SUCCESS"),
    "update": ("nothing()", "fail()"),
    "sys.exit in update": ("nothing()", "sys.exit(7)"),
    "a subscription": ("subscribe()", "pass"),
    "a subscription of nobody": ("subscribe_apart()", "pass"),
    "a service": ("serve()", "pass"),
    "a parameter": ("declare()", "pass"),
    "a timer": ("time()", "pass"),
    "sys.exit in a timer": ("leave()", "pass"),
    "a future": ("call()", "self.call_once()"),
    "feedback": ("connect()", "self.send_once()"),
    "SIGINT": ("nothing()", "pass"),
    "SIGTERM": ("nothing()", "pass"),
    "deactivate": ("nothing()", "pass"),
    "shut down": ("nothing()", "pass"),
    "cancel": ("nothing()", "pass"),
    "another goal": ("nothing()", "pass"),
}
ERRORS: Final = [*list(CODE)[1:11]]
COMMON: Final = [*list(CODE)[:13]]
CAUSES: Final = {
    "plain": COMMON,
    "lifecycle": [*COMMON, "deactivate", "shut down"],
    "server": [*COMMON, "cancel", "another goal"],
}
CALLS: Final = {"plain": "run_tree", "lifecycle": "manage_tree", "server": "serve_trees"}


def write(folder: Path, cause: str, kind: str = "Twist") -> None:
    """Writes the tree and its action into a folder."""
    setup, code = CODE[cause]
    source = GO.replace("SETUP", setup).replace("CAUSE", code).replace("SPEED", str(SPEED))
    (folder / "actions").mkdir(parents=True)
    (folder / "actions" / "Go.py").write_text(source.replace("KIND", kind))
    (folder / "tree.xml").write_text(XML)


class Yard:
    """A simulated robot that a program drives, and what makes the program's callbacks run."""

    def __init__(self, peer: Peer, domain_id: int) -> None:
        from geometry_msgs.msg import Twist, TwistStamped
        from rcl_interfaces.srv import SetParameters
        from rclpy.action import ActionServer
        from rosgraph_msgs.msg import Clock
        from std_msgs.msg import String
        from std_srvs.srv import Trigger
        from tf2_msgs.action import LookupTransform

        self.peer, self.domain_id = peer, domain_id
        self.commands = {
            "Twist": (Twist, lambda message: message),
            "TwistStamped": (TwistStamped, lambda message: message.twist),
        }
        self._clock = peer.node.create_publisher(Clock, "/clock", 1)
        self._cause = peer.node.create_publisher(String, "/cause", 1)
        self._own = peer.node.create_client(Trigger, "/cause")
        self._set = peer.node.create_client(SetParameters, "/program/set_parameters")
        peer.node.create_service(Trigger, "/theirs", lambda _, response: response)
        self._look = ActionServer(peer.node, LookupTransform, "/look", self._looked)
        self._kinds = Clock, String, Trigger, SetParameters, LookupTransform
        self._has_commanded = self._drives = False

    @contextlib.contextmanager
    def with_robot(self, kind: str = "Twist") -> Iterator[None]:
        """A world with a robot that takes commands of a type."""
        text = "format: bt-studio/universe\nversion: 1\nname: yard\nrobots: [{id: robot, model: turtle2}]\n"
        self.world = BulletWorld(parse_universe(text))
        self.world.step(STEPS)  # ROS has no time 0
        self._drives = False
        type_, twist_of = self.commands[kind]

        def command(message: Any) -> None:
            twist = twist_of(message)
            self.world.robots[0].command(twist.linear.x, twist.angular.z)
            self._has_commanded = True

        subscription = self.peer.node.create_subscription(type_, "/cmd_vel", command, 10)
        try:
            yield
        finally:
            self.peer.node.destroy_subscription(subscription)
            self.world.close()

    @property
    def speed(self) -> float:
        """The true speed in m/s."""
        return abs(self.world.robots[0].twist[0])

    def drive(self) -> None:
        """Lets the program tick, and time pass with its commands, until the robot moves."""
        self._until(lambda: self.speed > SPEED * 0.9, passes=True)

    def hold(self, happened: Callable[[], Any]) -> None:
        """Lets the program make the tick that is due, and no time pass, until something has happened."""
        self._until(happened, passes=False)

    def _until(self, happened: Callable[[], Any], *, passes: bool) -> None:
        end_s = time.monotonic() + DEADLINE_S
        while not happened():
            assert time.monotonic() < end_s, "it did not happen in time"
            self._publish_time()
            self._has_commanded = False
            again_s = time.monotonic() + AGAIN_S
            while not self._has_commanded and not happened() and time.monotonic() < again_s:
                self.peer.executor.spin_once(timeout_sec=0.01)
            self._drives |= self._has_commanded
            if passes and (self._has_commanded or not self._drives):
                self.world.step(STEPS)

    def _publish_time(self) -> None:
        clock = self._kinds[0]()
        now_s = self.world.time_s
        clock.clock.sec, clock.clock.nanosec = int(now_s), round(now_s % 1 * 1e9)
        self._clock.publish(clock)

    def cause(self, what: str, process: subprocess.Popen[str], folder: Path) -> None:
        """Ends the program, or begins to."""
        (folder / "now").touch()
        if what.startswith("a subscription"):
            self.peer.until(self._cause.get_subscription_count)
            self._cause.publish(self._kinds[1]())
        elif what == "a service":
            self.peer.until(self._own.service_is_ready)
            self._own.call_async(self._kinds[2].Request())
        elif what == "a parameter":
            from rclpy.parameter import Parameter

            self.peer.until(self._set.service_is_ready)
            wanted = [Parameter("cause", value=2.0).to_parameter_msg()]
            self._set.call_async(self._kinds[3].Request(parameters=wanted))
        elif what.startswith("SIG"):
            process.send_signal(getattr(signal, what))

    def stands(self, since_s: float) -> bool:
        """Lets the rest of the allowed time pass; returns whether the robot stands then."""
        while self.world.time_s < since_s + STANDS_WITHIN_S - 1e-6:
            self.world.step(STEPS)
        return self.speed < STANDS_M_S

    def until_it_is_told(self) -> None:
        """Handles the commands that the program has sent before it ended."""
        for _ in range(20):
            self.peer.executor.spin_once(timeout_sec=0.01)

    def _looked(self, handle: Any) -> Any:
        handle.publish_feedback(self._kinds[4].Feedback())
        handle.succeed()
        return self._kinds[4].Result()


@dataclass(frozen=True)
class Ended:
    """How one program has ended.

    Attributes:
        stands: whether the robot stood soon enough.
        status: the exit status of the program.
        wanted_status: the one that the table of `run-a-package.md` gives.
        is_told: whether the log has the error with its file, where there was one.
    """

    stands: bool
    status: int
    wanted_status: int
    is_told: bool


def end(yard: Yard, folder: Path, way: str, cause: str, kind: str = "Twist") -> Ended:
    """Runs a program until it drives the robot, ends it by a cause, and looks what the robot does."""
    write(folder, cause, kind)
    call = f"{CALLS[way]}('tree.xml', node_name='program', actions='actions', args=['--use_sim_time=true'])"
    with yard.with_robot(kind), program(folder, yard.domain_id, call) as process:
        over = _BEGIN[way](yard, folder)
        yard.drive()
        since_s = yard.world.time_s
        yard.cause(cause, process, folder)
        is_requested = cause in {"deactivate", "shut down", "cancel", "another goal"}
        is_over = over.ask(cause) if is_requested else over
        if cause.startswith("SIG"):
            is_over = lambda: False  # noqa: E731 - the program ends itself
        yard.hold(lambda: process.poll() is not None or is_over())
        yard.until_it_is_told()
        stands = yard.stands(since_s)
    said = (folder / "said").read_text()
    is_told = cause not in ERRORS or "actions/Go.py:" in said
    lives = way != "plain" or cause not in ERRORS
    return Ended(stands, process.returncode, ENDED if lives else BROKEN, is_told)


class Over:
    """Whether what a program ran is over, as its manager or its client hears."""

    def __init__(self, is_over: Callable[[], bool], ask: Callable[[str], Callable[[], bool]]) -> None:
        self._is_over = is_over
        self.ask = ask

    def __call__(self) -> bool:
        return self._is_over()


def _plain(_yard: Yard, _folder: Path) -> Over:
    return Over(lambda: False, lambda _: lambda: False)


def _lifecycle(yard: Yard, folder: Path) -> Over:
    from tests.tree_gardener.test_ros_lifecycle import ACTIVE, ACTIVE_SHUTDOWN, DEACTIVATE, Manager

    manager = Manager(yard.peer, folder, "program")
    manager.begin()

    def ask(what: str) -> Callable[[], bool]:
        asked = manager.ask(DEACTIVATE if what == "deactivate" else ACTIVE_SHUTDOWN)
        return lambda: bool(asked.done())

    states: list[Any] = []

    def is_over() -> bool:
        """Asks for the state again and again; a program that has ended does not answer."""
        if not states or states[-1].done():
            states.append(manager.ask_state())
        return any(each.done() and each.result().current_state.id != ACTIVE for each in states[-2:])

    return Over(is_over, ask)


def _server(yard: Yard, folder: Path) -> Over:
    from tests.tree_gardener.test_ros_server import Client

    client = Client(yard.peer, folder)
    handle = client.send("Main")
    result = handle.get_result_async()

    def ask(what: str) -> Callable[[], bool]:
        if what == "cancel":
            handle.cancel_goal_async()
        else:
            client.send("Nowhere")
        return lambda: bool(result.done())

    return Over(lambda: bool(result.done()), ask)


_BEGIN: Final = {"plain": _plain, "lifecycle": _lifecycle, "server": _server}
