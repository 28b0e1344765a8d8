"""``python -m tree_gardener run tree.xml``: runs a tree without anything else of BT Studio.

Exit status: 0 the root succeeded, 1 it failed or could not run, 2 bad arguments.
"""

import argparse
import contextlib
import pathlib
import sys
from collections.abc import Sequence
from contextlib import AbstractContextManager

from tree_gardener.actions import load_actions
from tree_gardener.clock import SystemClock
from tree_gardener.errors import LoadError, TickError
from tree_gardener.groot import PORT, GrootError
from tree_gardener.observe import TickChanges
from tree_gardener.runner import Overrun, Runner
from tree_gardener.status import SUCCESS, Status
from tree_gardener.tree import Tree
from tree_gardener.views import describe_changes


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command line; returns the exit status."""
    options = _parser().parse_args(arguments)
    try:
        nodes = load_actions(options.actions) if options.actions else {}
        tree = Tree.from_file(options.tree, nodes, main_tree=options.main_tree)
    except LoadError as error:
        print(error, file=sys.stderr)
        return 1
    except OSError as error:
        print(f"{options.tree}: {error.strerror}", file=sys.stderr)
        return 2
    try:
        with _published(tree, options):
            return _run(tree, options)
    except (GrootError, ImportError) as error:
        print(error, file=sys.stderr)
        return 2
    except TickError as error:
        print(error, error.traceback_text, sep="\n", file=sys.stderr)
        return 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tree_gardener", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("run", help="run a tree until its root succeeds or fails")
    run.add_argument("tree", type=pathlib.Path, help="an XML document, self-contained or not")
    run.add_argument("--actions", type=pathlib.Path, help="folder of the actions, one <Name>.py each")
    run.add_argument("--main-tree", help="the tree to run, if not the document's own choice")
    run.add_argument("--tick-hz", type=float, default=20.0, help="ticks a second (default 20)")
    run.add_argument("--repeat", action="store_true", help="continue after the root succeeded or failed")
    run.add_argument("--max-ticks", type=int, default=0, help="end after so many ticks")
    run.add_argument("--trace", action="store_true", help="print what changes at each tick")
    run.add_argument("--ros", action="store_true", help="give the actions an rclpy node and tick by ROS time")
    run.add_argument(
        "--groot2",
        type=int,
        nargs="?",
        const=PORT,
        metavar="PORT",
        help=f"let Groot2 follow and hold the tree; the port is {PORT} if none is given",
    )
    return parser


def _published(tree: Tree, options: argparse.Namespace) -> AbstractContextManager[object]:
    return contextlib.nullcontext() if options.groot2 is None else tree.publish_groot2(options.groot2)


def _run(tree: Tree, options: argparse.Namespace) -> int:
    if options.trace:

        def show(changes: TickChanges) -> None:
            print(f"tick {changes.tick}: {describe_changes(changes, tree)}")

        tree.observe(show)
    if options.ros:
        return _run_on_ros(tree, options)
    tree.setup()
    clock = SystemClock()
    runner = Runner(
        tree,
        tick_hz=options.tick_hz,
        on_finish="repeat" if options.repeat else "stop",
        overrun=lambda overrun: _warn(tree, overrun),
    )
    try:
        while not runner.is_finished:
            if runner.tick_due(clock.now()) is None:
                clock.sleep(min(0.001, runner.period_s / 4.0))
            elif options.max_ticks and tree.tick_number >= options.max_ticks:
                runner.stop()
    except KeyboardInterrupt:
        print("interrupted: the tree is halted", file=sys.stderr)
    finally:
        runner.shutdown()
    return _result(runner.status, runner.error)


def _run_on_ros(tree: Tree, options: argparse.Namespace) -> int:
    import tree_gardener.ros_wheels  # noqa: F401, PLC0415 - only with --ros, and before rclpy

    import rclpy  # noqa: PLC0415

    from tree_gardener.ros import RosClock, RosRunner  # noqa: PLC0415

    rclpy.init()
    node = rclpy.create_node("tree_gardener")
    tree.use_clock(RosClock(node))
    runner = RosRunner(tree, node, tick_hz=options.tick_hz, on_finish="repeat" if options.repeat else "stop")
    try:
        while rclpy.ok() and not runner.runner.is_finished:
            rclpy.spin_once(node, timeout_sec=0.1)
            if options.max_ticks and tree.tick_number >= options.max_ticks:
                runner.runner.stop()
    except KeyboardInterrupt:
        print("interrupted: the tree is halted", file=sys.stderr)
    finally:
        runner.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()
    return _result(runner.runner.status, runner.runner.error)


def _warn(tree: Tree, overrun: Overrun) -> None:
    slow = f" ({tree.nodes[overrun.slow_uid - 1].path})" if overrun.slow_uid else ""
    print(
        f"tick {overrun.tick} took {overrun.duration_s:.3f} s of {overrun.period_s:.3f} s{slow}",
        file=sys.stderr,
    )


def _result(status: Status, error: TickError | None) -> int:
    if error is not None:
        print(error, error.traceback_text, sep="\n", file=sys.stderr)
        return 1
    print(f"the root returned {status.name}")
    return 0 if status is SUCCESS else 1


if __name__ == "__main__":
    sys.exit(main())
