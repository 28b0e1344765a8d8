"""Runs a tree file as a ROS 2 node, a server of trees, or a lifecycle node; exported packages start it."""

import contextlib
import hashlib
import importlib
import pathlib
import re
import sys
from typing import TYPE_CHECKING, Any

from lxml import etree

from tree_gardener.actions import load_actions
from tree_gardener.errors import CallbackError, LoadError, TickError, in_full
from tree_gardener.groot import GrootError
from tree_gardener.ros import RosClock, RosRunner
from tree_gardener.ros_fields import check_fields
from tree_gardener.ros_parameters import (
    ParameterError,
    Parameters,
    RunParameters,
    ServerParameters,
    asks_for_help,
    declare_parameters,
    help_text,
    read_arguments,
    sim_time_problem,
)
from tree_gardener.status import Status
from tree_gardener.tree import Tree

if TYPE_CHECKING:
    import threading
    from collections.abc import Callable, Iterator, Sequence

    from tree_gardener.blackboard import Blackboard

# Many actions use `geometry_msgs.msg` after a mere `import geometry_msgs`: so the submodule is imported here.
_MESSAGES = (
    "builtin_interfaces",
    "geometry_msgs",
    "nav_msgs",
    "sensor_msgs",
    "std_msgs",
    "visualization_msgs",
)
_LAST_SPINS = 20
"""How often a server handles what is ready when it ends: requests for results come, and results go."""


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

    The node has the parameters ``tick_hz``, ``tree`` (path of the file), ``on_finish``, ``on_error``,
    ``groot2_port``, ``groot2_host`` and ``cmd_timeout_s``, and ROS 2's own ``use_sim_time``. The arguments
    of this function are their defaults; arguments such as ``--tick_hz=5.0`` on the command line override all
    others.

    Args:
        tree_file: the document; a self-contained one brings the sources of its actions.
        node_name: the name of the node.
        actions: a folder of sources, which override those in the document.
        tick_hz: ticks a second.
        on_finish: ``stop`` or ``repeat``, as for `Runner`.
        on_error: ``stop`` or ``failure``, as for `Runner`.
        args: the command line; that of the process, without the program, if None.

    Returns:
        The exit status: 0 when the tree ended or was stopped, 1 if it cannot start, 3 if an error ended it.
    """
    from tree_gardener.ros_node import ActionNode  # noqa: PLC0415 - the engine works without ROS

    def run(node: Any, settings: RunParameters, stop: "threading.Event") -> int:
        """Ticks a behaviour tree until it ends."""
        return _run(node, settings, actions, stop)

    defaults = RunParameters(pathlib.Path(tree_file), tick_hz, on_finish, on_error)
    return _on_a_node(node_name, ActionNode, defaults, args, run)


def serve_trees(  # noqa: PLR0913 - what main.py states of one package
    tree_file: "str | pathlib.Path",
    *,
    node_name: str,
    actions: "str | pathlib.Path | None" = None,
    tick_hz: float = 20.0,
    on_error: str = "stop",
    action_name: str = "bt_execution",
    on_new_goal: str = "preempt",
    args: "Sequence[str] | None" = None,
) -> int:
    """Serves the trees of a document as an action, until the process receives a signal.

    The action is ``btcpp_ros2_interfaces/action/ExecuteTree``, as of ``TreeExecutionServer``
    in BehaviorTree.ROS2.
    The parameters are those of `run_tree` without ``on_finish``, and ``action_name`` and ``on_new_goal``.

    Args:
        tree_file: the document.
        node_name: the name of the node.
        actions: a folder of sources, which override those in the document.
        tick_hz: ticks a second.
        on_error: ``stop`` aborts the goal when an action raises; ``failure`` makes that action fail.
        action_name: the name of the action.
        on_new_goal: ``preempt``, ``queue`` or ``reject``, when a tree runs.
        args: the command line; that of the process, without the program, if None.

    Returns:
        The exit status: 0 when the server was stopped, 1 if it cannot start, 3 if an error ended it.
    """
    from tree_gardener.ros_node import ActionNode  # noqa: PLC0415 - the engine works without ROS

    def serve(node: Any, settings: ServerParameters, stop: "threading.Event") -> int:
        """Runs behaviour trees by name, as the server of an action."""
        return _serve(node, settings, actions, stop)

    defaults = ServerParameters(pathlib.Path(tree_file), tick_hz, on_error, action_name, on_new_goal)
    return _on_a_node(node_name, ActionNode, defaults, args, serve)


def manage_tree(  # noqa: PLR0913 - what main.py states of one package
    tree_file: "str | pathlib.Path",
    *,
    node_name: str,
    actions: "str | pathlib.Path | None" = None,
    tick_hz: float = 20.0,
    on_finish: str = "stop",
    on_error: str = "stop",
    args: "Sequence[str] | None" = None,
) -> int:
    """Runs a tree as a lifecycle node, until the process receives a signal.

    The arguments are those of `run_tree`.

    Returns:
        The exit status: 0 when the node was stopped, 1 if it cannot start, 3 if an error ended it.
    """
    from tree_gardener.ros_lifecycle import LifecycleActionNode  # noqa: PLC0415 - the engine works without ROS

    def live(node: Any, settings: RunParameters, stop: "threading.Event") -> int:
        """Runs a behaviour tree as a lifecycle node."""
        return _live(node, settings, actions, stop)

    defaults = RunParameters(pathlib.Path(tree_file), tick_hz, on_finish, on_error)
    return _on_a_node(node_name, LifecycleActionNode, defaults, args, live)


def _on_a_node(
    name: str,
    kind: Any,
    defaults: Parameters,
    args: "Sequence[str] | None",
    run: "Callable[[Any, Parameters, threading.Event], int]",
) -> int:
    """Makes a node, reads its parameters, and runs something on it; returns the exit status."""
    check_fields()  # before the first message is loaded
    import rclpy  # noqa: PLC0415 - the engine works without ROS
    from rclpy.logging import get_logger  # noqa: PLC0415
    from rclpy.signals import SignalHandlerOptions  # noqa: PLC0415

    from tree_gardener.ros_spinning import NOT_STARTED, handled_signals  # noqa: PLC0415

    words = list(sys.argv[1:] if args is None else args)
    if asks_for_help(words):
        what = " ".join((run.__doc__ or "").split())
        print(help_text(name, what, defaults))  # noqa: T201 - it is what the command line asked for
        return 0
    _import_messages()
    log = get_logger(name)
    with handled_signals() as stop:
        try:
            # rclpy's own handlers would end the context before the tree could stop the robot.
            rclpy.init(args=words, signal_handler_options=SignalHandlerOptions.NO)
            node = _made(name, kind, words, type(defaults))
        except Exception as error:
            log.error(f"the node cannot start: {_in_one_line(error)}")
            rclpy.try_shutdown()
            return NOT_STARTED
        try:
            return run(node, declare_parameters(node, defaults, words), stop)
        except ParameterError as error:
            log.error(str(error))
            return NOT_STARTED
        finally:
            node.close()
            rclpy.try_shutdown()


def _made(
    name: str, kind: Any, words: "list[str]", parameters: "type[RunParameters | ServerParameters]"
) -> Any:
    from rclpy.exceptions import InvalidParameterTypeException  # noqa: PLC0415
    from rclpy.parameter import Parameter  # noqa: PLC0415
    from rclpy.utilities import remove_ros_args  # noqa: PLC0415

    given = read_arguments(remove_ros_args(words), parameters)
    overrides = [Parameter(key, value=value) for key, value in given.items()]
    try:
        return kind(name, parameter_overrides=overrides)
    except InvalidParameterTypeException as error:
        # At this point rclpy has declared parameters of its own only.
        problem = sim_time_problem(words) if "'use_sim_time'" in str(error) else str(error)
        raise ParameterError(problem) from error


def _in_one_line(error: Exception) -> str:
    """Returns the message of an rclpy error without the place in the C library's sources."""
    text = re.sub(r", at \S+:\d+", "", " ".join(str(error).split()))
    return text or type(error).__name__


def _run(
    node: Any, settings: RunParameters, actions: "str | pathlib.Path | None", stop: "threading.Event"
) -> int:
    from tree_gardener.ros_spinning import (  # noqa: PLC0415 - the engine works without ROS
        BROKEN,
        ENDED,
        LAST_ZEROS,
        NOT_STARTED,
        spinning,
    )

    with spinning(node, stop, settings.cmd_timeout_s) as spinner, _groot2(node, settings) as follow:
        runner = _load(node, settings, actions, spinner.stop)
        if runner is None:
            return NOT_STARTED
        follow(runner.runner.tree)
        spinner.broken = runner.fail
        try:
            while spinner.once():
                pass
        finally:
            runner.stop()
            spinner.await_answers()
            runner.shutdown()
            node.commanded.stop(LAST_ZEROS)
            node.commanded.end()
        return ENDED if runner.runner.error is None else BROKEN


def _serve(
    node: Any, settings: ServerParameters, actions: "str | pathlib.Path | None", stop: "threading.Event"
) -> int:
    from tree_gardener.ros_node import MainThreadGroup  # noqa: PLC0415 - the engine works without ROS
    from tree_gardener.ros_server import TreeServer  # noqa: PLC0415
    from tree_gardener.ros_spinning import NOT_STARTED, spinning  # noqa: PLC0415

    def load(name: str, board: "Blackboard") -> Tree:
        return follow(_tree(node, settings.tree, actions, main_tree=name or None, blackboard=board))

    with spinning(node, stop, settings.cmd_timeout_s) as spinner, _groot2(node, settings) as follow:
        try:
            server = TreeServer(
                node,
                action_name=settings.action_name,
                load=load,
                on_new_goal=settings.on_new_goal,
                callback_group=MainThreadGroup(),
                tick_hz=settings.tick_hz,
                on_error=settings.on_error,
            )
        except ModuleNotFoundError as error:
            node.get_logger().error(
                f"{error}: put btcpp_ros2_interfaces of github.com/BehaviorTree/BehaviorTree.ROS2 into the"
                " workspace, build it and source it"
            )
            return NOT_STARTED
        node.get_logger().info(f"trees of {settings.tree.name} run by {settings.action_name}")
        spinner.broken = spinner.unless(server.fail)
        try:
            while spinner.once(server.step):
                pass
        finally:
            server.stop(spinner.await_answers)
            for _ in range(_LAST_SPINS):
                spinner.once()
            server.close()
        return _status_of(spinner, node)


def _live(
    node: Any, settings: RunParameters, actions: "str | pathlib.Path | None", stop: "threading.Event"
) -> int:
    from tree_gardener.ros_lifecycle import TreeLife  # noqa: PLC0415 - the engine works without ROS
    from tree_gardener.ros_spinning import spinning  # noqa: PLC0415

    with spinning(node, stop, settings.cmd_timeout_s) as spinner, _groot2(node, settings) as follow:
        life = TreeLife(
            node,
            lambda: follow(_tree(node, settings.tree, actions)),
            tick_hz=settings.tick_hz,
            on_finish=settings.on_finish,
            on_error=settings.on_error,
        )
        node.manage(life)
        spinner.broken = spinner.unless(life.fail)
        try:
            while spinner.once(life.step):
                pass
        finally:
            life.end(spinner.await_answers)
        return _status_of(spinner, node)


def _status_of(spinner: Any, node: Any) -> int:
    """Returns the exit status of a program that runs trees on request; logs the error that ended it."""
    from tree_gardener.ros_spinning import BROKEN, ENDED  # noqa: PLC0415 - the engine works without ROS

    if spinner.error is None:
        return ENDED
    node.get_logger().error(in_full(CallbackError.of(spinner.error)))
    return BROKEN


@contextlib.contextmanager
def _groot2(node: Any, settings: "RunParameters | ServerParameters") -> "Iterator[Callable[[Tree], Tree]]":
    """Yields the function that serves a tree to Groot2, in place of the one before, and returns it.

    Without a port it does nothing. A tree that cannot be served runs all the same; the log says why.
    """
    log = node.get_logger()
    served = contextlib.ExitStack()

    def follow(tree: Tree) -> Tree:
        served.close()
        if settings.groot2_port:
            try:
                served.enter_context(tree.publish_groot2(settings.groot2_port, settings.groot2_host))
                log.info(f"Groot2 can follow the tree at {settings.groot2_host}:{settings.groot2_port}")
            except (GrootError, ModuleNotFoundError) as error:
                log.error(f"Groot2 cannot follow the tree: {error}")
        return tree

    with served:
        yield follow


def _load(
    node: Any, settings: RunParameters, actions: "str | pathlib.Path | None", stop: "threading.Event"
) -> "RosRunner | None":
    from tree_gardener.ros_node import MainThreadGroup  # noqa: PLC0415 - the engine works without ROS

    log = node.get_logger()
    path = settings.tree

    def finished(status: Status) -> None:
        log.info(f"the tree ended with {status.name}")
        stop.set()

    try:
        tree = _tree(node, path, actions)
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
        log.error(in_full(error))
    return None


def _tree(
    node: Any,
    path: pathlib.Path,
    actions: "str | pathlib.Path | None",
    *,
    main_tree: "str | None" = None,
    blackboard: "Blackboard | None" = None,
) -> Tree:
    """Loads a tree of a document, by the node's time."""
    text = path.read_bytes()
    folder = pathlib.Path(actions) if actions is not None else None
    classes = {}
    if folder is not None:
        sources = _sources(text, folder, node.get_logger())
        embedded = {name for name, _ in _embedded(text, "Action")}
        classes = load_actions(sources, only=[name for name in sources if name in embedded])
    return Tree.from_xml(
        text, nodes=classes, clock=RosClock(node), name=str(path), main_tree=main_tree, blackboard=blackboard
    )


def _sources(text: bytes, folder: pathlib.Path, log: Any) -> "dict[str, str]":
    """Returns the sources of a document's actions; a file in the folder overrides the document's copy."""
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))  # modules that the actions share
    sources = {}
    for name, digest in (*_embedded(text, "Action"), *_embedded(text, "Module")):
        file = folder / f"{name}.py"
        if not file.is_file():
            continue
        raw = file.read_bytes()
        if digest and hashlib.sha256(raw).hexdigest() != digest:
            log.info(f"{file} was changed after it was put into the tree's XML; the file is what runs")
        sources[name] = raw.decode("utf-8-sig")
    return sources


def _embedded(text: bytes, tag: str) -> "Iterator[tuple[str, str]]":
    """Returns names and digests of the actions, or of the modules, that a document contains."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    with contextlib.suppress(etree.XMLSyntaxError):  # loading the tree reports it with a better place
        for source in etree.fromstring(text, parser).iterfind(f"Code/{tag}"):
            yield str(source.get("name", "")), str(source.get("sha256", ""))


def _import_messages() -> None:
    for package in _MESSAGES:
        with contextlib.suppress(ImportError):
            importlib.import_module(f"{package}.msg")
