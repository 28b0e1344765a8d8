"""The process of the actions of a sealed run: `python -m executor.evaluation.sealed.actions --link-fd N`.

It seals itself before anything of the run reaches it, then loads the tree and does what the judge's end asks.
"""

from __future__ import annotations

import argparse
import os
import socket
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import translator  # noqa: F401 - its folder cannot be found any more when the process is sealed
import tree_gardener  # noqa: F401 - as above
from executor.evaluation.sealed.confine import SealError, seal
from executor.evaluation.sealed.link import (
    Failed,
    Fault,
    Link,
    LinkClosedError,
    LinkError,
    Load,
    Loaded,
    Look,
    Resume,
    Seen,
    Switch,
    Tick,
    Ticked,
    ToActions,
    Waits,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.evaluation.sealed.gateway import Gateway
    from tree_gardener import TickError, Tree
    from tree_gardener.runner import Runner

MOST_TEXT: Final = 2000
NAVIGATION_HZ: Final = 4.0


class _NavigationError(Exception):
    """The actions use Nav2, which a sealed run does not have."""


class Actions:
    """The tree, its actions, and their part of the ROS graph."""

    def __init__(self, link: Link, scratch: Path) -> None:
        self._link = link
        self._scratch = scratch
        self._now_s = 0.0
        self._ticks = 0
        self._is_setting_up = True
        self._faults: list[Fault] = []
        self._gateway: Gateway
        self._tree: Tree
        self._runner: Runner
        self._executor: Any

    def serve(self) -> None:
        """Does what the judge's end asks, until it closes the link."""
        from tree_gardener.errors import LoadError, TickError  # noqa: PLC0415 - after the sealing

        load = self._link.receive_of_judge()
        if not isinstance(load, Load):
            raise LinkError("the first message loads the tree")
        try:
            self._load(load)
            self._check_navigation()
        except LoadError as error:
            self._fail(str(error.diagnostics[0]))
        except TickError as error:
            self._fail(place_of(_fault_of(error)))
        except _NavigationError as error:
            self._fail(str(error))
        else:
            self._link.send(Loaded(self._gateway.listeners()))
        while True:
            self._do(self._link.receive_of_judge())

    def now(self) -> float:
        """Returns the simulated time in s: the clock of the tree."""
        return self._now_s

    def sleep(self, duration_s: float) -> None:
        """Does nothing: simulated time does not pass within a tick."""

    def _load(self, load: Load) -> None:
        from rclpy.parameter import Parameter  # noqa: PLC0415 - ROS reads the environment when loaded

        from executor.application.host import enter, prepare  # noqa: PLC0415 - as above
        from executor.application.randomness import seed_randomness  # noqa: PLC0415
        from executor.evaluation.sealed.gateway import Gateway  # noqa: PLC0415
        from executor.headless.files import write_files  # noqa: PLC0415
        from executor.headless.waiting import wait_in_simulation  # noqa: PLC0415
        from executor.ros.default_context import DefaultContext  # noqa: PLC0415
        from executor.ros.shared_topics import share_commands  # noqa: PLC0415
        from executor.ros.spin import DrainingExecutor  # noqa: PLC0415
        from tree_gardener import Tree  # noqa: PLC0415
        from tree_gardener.ros_node import ActionNode  # noqa: PLC0415
        from tree_gardener.runner import Runner  # noqa: PLC0415

        context = DefaultContext(simulated=True).context
        self._gateway = Gateway(context, load.publishers, load.subscriptions)
        self._gateway.publish(load.sent)
        share_commands(self._gateway, context)
        node = ActionNode(
            "application",
            context=context,
            parameter_overrides=[Parameter("use_sim_time", Parameter.Type.BOOL, True)],  # noqa: FBT003
        )
        self._executor = DrainingExecutor(context=context)
        self._executor.add_node(node)
        wait_in_simulation(self.now, self._let_time_pass)
        folder = self._scratch / "app"
        folder.mkdir()
        write_files(folder, load.files)
        prepare()
        enter(folder)
        seed_randomness(load.seed)
        self._tree = Tree.from_xml(load.tree, clock=self)
        self._tree.setup(node=node)
        self._counts = self._tree.count_results()
        self._navigation_every = max(1, round(load.tick_hz / NAVIGATION_HZ))
        self._runner = Runner(
            self._tree,
            tick_hz=load.tick_hz,
            on_finish=load.on_finish,
            on_error=load.on_error,
            fault=lambda error: self._faults.append(_fault_of(error)),
            halted=node.commanded.stop,
        )

    def _do(self, message: ToActions) -> None:
        match message:
            case Tick():
                self._now_s = message.time_s
                self._gateway.publish(message.sent)
                self._answer_tick()
            case Switch() | Look():
                self._answer_aside(message)
            case _:
                raise LinkError("a message came out of turn")

    def _answer_aside(self, message: Switch | Look) -> None:
        """Answers what may be asked also while an action waits."""
        if isinstance(message, Switch):
            from executor.evaluation.action_faults import switch_action  # noqa: PLC0415 - after the sealing

            switch_action(self._tree, message.tree, message.node, on=message.on)
        else:
            from executor.evaluation.outcome import letters_of  # noqa: PLC0415 - as above

            self._link.send(Seen(letters_of(self._tree, self._counts)))

    def _answer_tick(self) -> None:
        try:
            self._call_back()
            status = self._runner.tick_now()
            self._ticks += 1
            if self._ticks % self._navigation_every == 0:
                self._check_navigation()
        except _NavigationError as error:
            self._fail(str(error))
            return
        faults, self._faults = self._faults, []
        self._link.send(
            Ticked(
                self._gateway.listeners(),
                self._gateway.heard(),
                None if status is None else status.name,
                self._runner.status.name,
                self._runner.is_finished,
                faults,
            )
        )

    def _call_back(self) -> None:
        """Runs the callbacks of the actions; an exception of one may end the run."""
        try:
            self._executor.drain()
        except _NavigationError:
            raise
        except (Exception, SystemExit) as error:
            self._runner.fail(error)

    def _let_time_pass(self) -> None:
        """Asks for time while an action waits in rclpy."""
        from executor.headless.lockstep import TOO_LONG  # noqa: PLC0415 - after the sealing

        self._link.send(Waits(self._gateway.listeners(), self._gateway.heard()))
        while not isinstance(message := self._link.receive_of_judge(), Resume):
            if not isinstance(message, Switch | Look):
                raise LinkError("a message came out of turn")
            self._answer_aside(message)
        if message.is_over:
            raise TimeoutError(TOO_LONG)
        self._now_s = message.time_s
        self._gateway.publish(message.sent)
        self._check_navigation()

    def _check_navigation(self) -> None:
        used = self._gateway.navigation_in_use()
        if used:
            raise _NavigationError(f"a sealed run has no navigation, and the actions use {used}")

    def _fail(self, text: str) -> None:
        self._link.send(Failed(text[:MOST_TEXT]))


def place_of(fault: Fault) -> str:
    """Returns an exception with its place, as one line."""
    where = f"{fault.file}:{fault.line or 1}:1: " if fault.file else ""
    return f"{where}{fault.path}: {fault.message}" if fault.path else f"{where}{fault.message}"


def _fault_of(error: TickError) -> Fault:
    return Fault(error.message[:MOST_TEXT], error.file, error.line, error.path)


def main(arguments: list[str] | None = None, exit_: Callable[[int], Any] = os._exit) -> None:
    """Serves the judge's end of a link."""
    parser = argparse.ArgumentParser(prog="python -m executor.evaluation.sealed.actions", description=__doc__)
    parser.add_argument("--link-fd", type=int, required=True)
    parser.add_argument("--scratch", type=Path, required=True)
    parser.add_argument("--uid", type=int)
    options = parser.parse_args(arguments)
    link = Link(socket.socket(fileno=options.link_fd))
    try:
        seal(options.scratch, uid=options.uid)
    except SealError as error:
        link.send(Failed(str(error)))
        exit_(1)
    os.chdir(options.scratch)
    Actions(link, options.scratch).serve()


if __name__ == "__main__":
    try:
        main()
    except (LinkClosedError, LinkError):
        pass
    finally:
        os._exit(0 if sys.exc_info()[0] is None else 1)
