"""Runs one tree file as a ROS 2 node; exported packages start it."""

import contextlib
import hashlib
import importlib
import pathlib
import re
import signal
import sys
import threading
import time
from typing import TYPE_CHECKING, Any

from lxml import etree

from tree_gardener.actions import load_actions
from tree_gardener.errors import LoadError, TickError
from tree_gardener.ros import RosClock, RosRunner
from tree_gardener.ros_parameters import (
    ParameterError,
    RunParameters,
    declare_parameters,
    read_arguments,
    sim_time_problem,
)
from tree_gardener.status import Status
from tree_gardener.tree import Tree

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

# Many actions use `geometry_msgs.msg` after a mere `import geometry_msgs`: so the submodule is imported here.
_MESSAGES = (
    "builtin_interfaces",
    "geometry_msgs",
    "nav_msgs",
    "sensor_msgs",
    "std_msgs",
    "visualization_msgs",
)
_POLL_S = 0.1
_CLOCK_S = 5.0


def run_tree(  # noqa: PLR0913 - what main.py states of one package
    tree_file: "str | pathlib.Path",
    *,
    node_name: str,
    actions: "str | pathlib.Path | None" = None,
    tick_hz: float = 20.0,
    on_finish: str = "stop",
    on_error: str = "stop",
    args: "Sequence[str] | None" = None,
) -> int:
    """Ticks a tree by ROS time until it ends, or the process receives a signal.

    The node has the parameters ``tick_hz``, ``tree`` (path of the file), ``on_finish`` and ``on_error``, and
    ROS 2's own ``use_sim_time``. The arguments of this function are their defaults; arguments such as
    ``--tick_hz=5.0`` on the command line override all others.

    Args:
        tree_file: the document; a self-contained one brings the sources of its actions.
        node_name: the name of the node.
        actions: a folder of sources, which override those in the document.
        tick_hz: ticks a second.
        on_finish: ``stop`` or ``repeat``, as for `Runner`.
        on_error: ``stop`` or ``failure``, as for `Runner`.
        args: the command line; that of the process, without the program, if None.

    Returns:
        The exit status: 0 when the tree ended or was stopped, 1 after an error.
    """
    import rclpy  # noqa: PLC0415 - the engine works without ROS
    from rclpy.logging import get_logger  # noqa: PLC0415
    from rclpy.signals import SignalHandlerOptions  # noqa: PLC0415

    _import_messages()
    defaults = RunParameters(pathlib.Path(tree_file), tick_hz, on_finish, on_error)
    words = list(sys.argv[1:] if args is None else args)
    log = get_logger(node_name)
    try:
        # rclpy's own handlers would end the context before the tree could stop the robot.
        rclpy.init(args=words, signal_handler_options=SignalHandlerOptions.NO)
        node = _made(node_name, words)
    except Exception as error:
        log.error(f"the node cannot start: {_in_one_line(error)}")
        rclpy.try_shutdown()
        return 1
    try:
        settings = declare_parameters(node, defaults, words)
        return _run(node, settings, actions)
    except ParameterError as error:
        log.error(str(error))
        return 1
    finally:
        node.close()
        rclpy.try_shutdown()


def _made(name: str, words: "list[str]") -> Any:
    from rclpy.exceptions import InvalidParameterTypeException  # noqa: PLC0415
    from rclpy.parameter import Parameter  # noqa: PLC0415
    from rclpy.utilities import remove_ros_args  # noqa: PLC0415

    from tree_gardener.ros_node import ActionNode  # noqa: PLC0415

    given = read_arguments(remove_ros_args(words))
    overrides = [Parameter(key, value=value) for key, value in given.items()]
    try:
        return ActionNode(name, parameter_overrides=overrides)
    except InvalidParameterTypeException as error:
        # At this point rclpy has declared parameters of its own only.
        problem = sim_time_problem(words) if "'use_sim_time'" in str(error) else str(error)
        raise ParameterError(problem) from error


def _in_one_line(error: Exception) -> str:
    """Returns the message of an rclpy error without the place in the C library's sources."""
    text = re.sub(r", at \S+:\d+", "", " ".join(str(error).split()))
    return text or type(error).__name__


def _run(node: Any, settings: RunParameters, actions: "str | pathlib.Path | None") -> int:
    import rclpy  # noqa: PLC0415
    from rclpy.executors import SingleThreadedExecutor  # noqa: PLC0415

    from tree_gardener.ros_node import guard_rclpy  # noqa: PLC0415

    stop = threading.Event()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    end_guard = guard_rclpy()
    try:
        with _handled_signals(stop):
            runner = _load(node, settings, actions, stop)
            if runner is None:
                return 1
            patience = _ClockPatience(node)
            while rclpy.ok() and not stop.is_set():
                executor.spin_once(timeout_sec=_POLL_S)
                patience.look()
            failed = runner.runner.error is not None
            runner.shutdown()
            return 1 if failed else 0
    finally:
        end_guard()
        executor.shutdown()


class _ClockPatience:
    """Warns once that no simulated time arrives; the tree would wait silently otherwise."""

    def __init__(self, node: Any) -> None:
        self._node = node
        self._waits = bool(node.get_parameter("use_sim_time").value)
        self._end_s = time.monotonic() + _CLOCK_S

    def look(self) -> None:
        """Checks the clock from time to time."""
        if not self._waits:
            return
        if self._node.get_clock().now().nanoseconds > 0:
            self._waits = False
        elif time.monotonic() > self._end_s:
            self._waits = False
            self._node.get_logger().warning(
                f"use_sim_time is true, but no time came on /clock in {_CLOCK_S:.0f} s; the tree waits for it"
            )


def _load(
    node: Any, settings: RunParameters, actions: "str | pathlib.Path | None", stop: threading.Event
) -> "RosRunner | None":
    from tree_gardener.ros_node import MainThreadGroup  # noqa: PLC0415 - the engine works without ROS

    log = node.get_logger()
    path = settings.tree

    def finished(status: Status) -> None:
        log.info(f"the tree ended with {status.name}")
        stop.set()

    try:
        text = path.read_bytes()
        classes = load_actions(_sources(text, pathlib.Path(actions), log)) if actions is not None else {}
        tree = Tree.from_xml(text, nodes=classes, clock=RosClock(node), name=str(path))
        return RosRunner(
            tree,
            node,
            tick_hz=settings.tick_hz,
            on_finish=settings.on_finish,
            on_error=settings.on_error,
            finished=finished,
            callback_group=MainThreadGroup(),
        )
    except OSError as error:
        log.error(f"{path} cannot be read: {error.strerror}")
    except LoadError as error:
        for problem in error.diagnostics:
            log.error(str(problem))
    except TickError as error:  # the `setup` of an action; its traceback is for its author
        log.error(f"{error}\n{error.traceback_text}")
    return None


def _sources(text: bytes, folder: pathlib.Path, log: Any) -> "dict[str, str]":
    """Returns the sources of a document's actions; a file in the folder overrides the document's copy."""
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))  # modules that the actions share
    sources = {}
    for name, digest in _embedded(text):
        file = folder / f"{name}.py"
        if not file.is_file():
            continue
        raw = file.read_bytes()
        if digest and hashlib.sha256(raw).hexdigest() != digest:
            log.info(f"{file} was changed after it was put into the tree's XML; the file is what runs")
        sources[name] = raw.decode("utf-8-sig")
    return sources


def _embedded(text: bytes) -> "Iterator[tuple[str, str]]":
    """Returns names and digests of the actions that a document contains."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    with contextlib.suppress(etree.XMLSyntaxError):  # loading the tree reports it with a better place
        for action in etree.fromstring(text, parser).iterfind("Code/Action"):
            yield str(action.get("name", "")), str(action.get("sha256", ""))


def _import_messages() -> None:
    for package in _MESSAGES:
        with contextlib.suppress(ImportError):
            importlib.import_module(f"{package}.msg")


@contextlib.contextmanager
def _handled_signals(stop: threading.Event) -> "Iterator[None]":
    """Ends the run in order after SIGINT or SIGTERM, while the context lasts."""
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(number, lambda *_: stop.set()) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)
