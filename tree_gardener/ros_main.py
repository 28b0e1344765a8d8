"""Runs one tree file as a ROS 2 node: what exported packages start."""

import contextlib
import hashlib
import importlib
import pathlib
import signal
import sys
import threading
from typing import TYPE_CHECKING, Any

from lxml import etree

from tree_gardener.actions import load_actions
from tree_gardener.errors import LoadError
from tree_gardener.ros import RosClock, RosRunner
from tree_gardener.status import Status
from tree_gardener.tree import Tree

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

# Many actions use `geometry_msgs.msg` after a mere `import geometry_msgs`: someone must have imported it.
_MESSAGES = (
    "builtin_interfaces",
    "geometry_msgs",
    "nav_msgs",
    "sensor_msgs",
    "std_msgs",
    "visualization_msgs",
)
_POLL_S = 0.1


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
    """Ticks a tree by ROS time until it ends, or the process is asked to.

    The node has the parameters ``tick_hz`` and ``tree`` (path of the file), and ROS 2's own ``use_sim_time``.

    Args:
        tree_file: the document; a self-contained one brings the sources of its actions.
        node_name: the name of the node.
        actions: a folder of sources, which go before those in the document.
        tick_hz: ticks a second, unless the parameter says otherwise.
        on_finish: ``stop`` or ``repeat``, as `Runner` has it.
        on_error: ``stop`` or ``failure``, as `Runner` has it.
        args: the command line for rclpy; that of the process if None.

    Returns:
        The exit status: 0 when the tree ended or was stopped, 1 after an error.
    """
    import rclpy  # noqa: PLC0415 - the engine works without ROS
    from rclpy.signals import SignalHandlerOptions  # noqa: PLC0415

    _import_messages()
    # Our own handlers, since rclpy's would end the context before the tree could stop the robot.
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node(node_name)
    stop = threading.Event()
    try:
        with _handled_signals(stop):
            rate = float(node.declare_parameter("tick_hz", float(tick_hz)).value)
            path = pathlib.Path(str(node.declare_parameter("tree", str(tree_file)).value))
            runner = _load(node, path, actions, stop, tick_hz=rate, on_finish=on_finish, on_error=on_error)
            if runner is None:
                return 1
            while rclpy.ok() and not stop.is_set():
                rclpy.spin_once(node, timeout_sec=_POLL_S)
            failed = runner.runner.error is not None
            runner.shutdown()
            return 1 if failed else 0
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _load(
    node: Any,
    path: pathlib.Path,
    actions: "str | pathlib.Path | None",
    stop: threading.Event,
    **settings: Any,
) -> "RosRunner | None":
    log = node.get_logger()

    def finished(status: Status) -> None:
        log.info(f"the tree ended with {status.name}")
        stop.set()

    try:
        text = path.read_bytes()
        classes = load_actions(_sources(text, pathlib.Path(actions), log)) if actions is not None else {}
        tree = Tree.from_xml(text, nodes=classes, clock=RosClock(node), name=str(path))
        return RosRunner(tree, node, finished=finished, **settings)
    except OSError as error:
        log.error(f"{path} cannot be read: {error.strerror}")
    except LoadError as error:
        for problem in error.diagnostics:
            log.error(str(problem))
    return None


def _sources(text: bytes, folder: pathlib.Path, log: Any) -> "dict[str, str]":
    """The sources of the actions of a document; a file in the folder goes before the copy in the document."""
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
    """Names and digests of the actions that a document brings."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    with contextlib.suppress(etree.XMLSyntaxError):  # which loading the tree will tell better
        for action in etree.fromstring(text, parser).iterfind("Code/Action"):
            yield str(action.get("name", "")), str(action.get("sha256", ""))


def _import_messages() -> None:
    for package in _MESSAGES:
        with contextlib.suppress(ImportError):
            importlib.import_module(f"{package}.msg")


@contextlib.contextmanager
def _handled_signals(stop: threading.Event) -> "Iterator[None]":
    """Lets SIGINT and SIGTERM end the run in order."""
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(number, lambda *_: stop.set()) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)
