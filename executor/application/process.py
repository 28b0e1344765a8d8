"""The application as a process of its own: `python -m executor.application.process --channel-fd N`.

The process may be started as a spare: it then imports slow modules, joins the ROS graph, and waits for the
message ``start``. The main thread loads, ticks and runs the actions' callbacks; a second one receives
messages of the manager; a third one sends beats (`executor.supervision.pulse`).
"""

from __future__ import annotations

import argparse
import contextlib
import gc
import os
import queue
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor import child_messages
from executor.application.host import serve, start_listener
from executor.application.python.debugger import PythonDebugger, trace
from executor.child_messages import FromApplication, StartApplication, ToApplication, decode_to_application
from executor.recorder.link import ADDRESS_VARIABLE
from executor.run_inputs import done_by

if TYPE_CHECKING:
    from types import FrameType

    from executor.application.changes.program import Program
    from executor.application.debugging import ApplicationDebugger
    from executor.application.debugging import Wanted as DebuggerCommand
    from executor.application.profiling import ApplicationProfile
    from executor.application.recording import ApplicationRecorder
    from executor.application.report import Report
    from executor.application.ros import ApplicationGraph
    from executor.supervision.channel import Channel
    from executor.supervision.pulse import Pulse
    from tree_gardener import Status, TickError, Tree
    from tree_gardener.runner import Runner

SPIN_S: Final = 0.05
DISCOVERY_S: Final = 0.8
GOODBYE_S: Final = 0.5


class Ended(Exception):  # noqa: N818 - the way out, not an error
    """Raised to end the main loop when the run is over."""


class Application:
    """Loads one application, runs it, and reports how it ended."""

    def __init__(self, channel: Channel[FromApplication, ToApplication], pulse: Pulse) -> None:
        from executor.application.groot import ApplicationPublisher  # noqa: PLC0415 - as below
        from executor.application.locate import Locator  # noqa: PLC0415 - after the environment is set
        from executor.application.report import Reporter  # noqa: PLC0415 - as above
        from executor.application.watchdog import Breaker  # noqa: PLC0415 - as above

        self._channel = channel
        self._pulse = pulse
        self._commands: queue.SimpleQueue[ToApplication] = queue.SimpleQueue()
        self._groot = ApplicationPublisher.of_environment()
        self._graph: ApplicationGraph = self._make_graph()
        self._reporter = Reporter(self._report, self._now)
        self._locator = Locator()
        self._breaker = Breaker(self._locator)
        pulse.locate = self._locator.beat_place
        self._program: Program | None = None
        self._python_debugger = PythonDebugger(pulse, channel.send, self._report_hold_in_python)
        self._runner: Runner | None = None
        self._recorder: ApplicationRecorder | None = None
        self._debugger: ApplicationDebugger | None = None
        self._profile: ApplicationProfile | None = None
        self._stops_held = False
        """Whether a robot stops while the tree is held; one outside does not wait."""
        self._connect_by_s: float | None = None
        self._begin_s: float | None = None
        """The time until it resumes, where the clock may still be that of before."""
        self._is_connected = False
        self.pid = os.getpid()
        """The process that it is; a process that an action forked must not close the ROS node."""

    def run(self) -> None:
        """Runs until the run is over or the manager is gone."""
        self._start_listener()
        start = self._wait_for_start()
        if start is None:
            return
        self._begin_s = start.time_s
        with self._pulse.busy("loading"):
            self._channel.send(child_messages.Starting())
            self._redirect_output()
            self._join(start)
            if not self._load(start):
                return
        if not self._catch_up(start):
            return
        # Later collections leave alone what is there now: they are short, and snapshots share its pages.
        gc.freeze()
        self._channel.send(child_messages.ApplicationReady())
        self._breaker.arm()
        try:
            while True:
                self._turn()
        except Ended:
            pass
        self._breaker.disarm()
        self._say_goodbye()

    def close(self) -> None:
        """Sends the last messages and leaves the ROS graph."""
        if self._profile is not None:
            self._profile.close()
        if self._recorder is not None:
            self._recorder.close()
        self._channel.flush(GOODBYE_S)
        self._graph.close()

    def _make_graph(self) -> ApplicationGraph:
        """Returns the graph that the spare joins."""
        from executor.application.ros import Graph  # noqa: PLC0415 - after the environment is set

        return Graph(int(os.environ["ROS_DOMAIN_ID"]), self._on_clock)

    def _catch_up(self, start: StartApplication) -> bool:
        """Does what comes before the run; returns whether the run can begin."""
        return True

    def _report(self, message: Report) -> None:
        """Sends what the tree has to report."""
        self._channel.send(message)

    def _start_listener(self) -> None:
        start_listener(self._channel, self._take)

    def _take(self, message: ToApplication) -> None:
        """Queues a message of the manager for the main thread, from the thread that listens."""
        self._commands.put(message)
        self._graph.wake()

    def _wait_for_start(self) -> StartApplication | None:
        self._pulse.rests()
        while True:
            self._pulse.moved()
            # Spinning continues the discovery of the graph.
            self._graph.spin_once(SPIN_S)
            while not self._commands.empty():
                message = self._commands.get()
                if isinstance(message, child_messages.Stop):
                    return None
                if isinstance(message, StartApplication):
                    return message

    def _turn(self) -> None:
        self._pulse.moved()
        if self._breaker.is_interrupted:
            raise Ended
        while not self._commands.empty():
            self._obey(self._commands.get())
        self._reporter.flush()
        if self._recorder is not None:
            self._recorder.pump()
        if self._debugger is not None:
            self._debugger.between_ticks()
        if self._profile is not None:
            self._profile.between_ticks()
        self._guarded(self._work)

    def _work(self) -> None:
        """Runs what is due, or waits a moment for it."""
        self._graph.spin_once(SPIN_S)

    def serve_held(self) -> None:
        """Obeys the session while the tree is held; callbacks and timers of ROS do not run."""
        self._pulse.moved()
        self._reporter.flush()
        if self._recorder is not None:
            self._recorder.pump()
        if self._stops_held:
            self._graph.node.commanded.stop()
        with contextlib.suppress(queue.Empty):
            self._obey(self._commands.get(timeout=SPIN_S))

    def show_held(self) -> None:
        """Reports the entries that the tick in progress has written."""
        assert self._runner is not None  # noqa: S101 - it ticks
        self._reporter.held(self._runner.tree)

    def note_input(self, command: str, data: Any, tick: int, hook: int) -> None:
        """Records what a person did."""
        if self._recorder is not None:
            self._recorder.did(command, data, tick, hook)

    def _obey(self, message: ToApplication) -> None:  # noqa: C901, PLR0912 - one case a message
        from executor.application.changes.live_ports import set_port  # noqa: PLC0415 - as all of the engine
        from tree_gardener.debugging import DebuggingEnded  # noqa: PLC0415 - as above

        runner = self._runner
        assert runner is not None  # noqa: S101 - commands come after `ready`
        assert self._recorder is not None  # noqa: S101 - as above
        debugger = self._debugger
        assert debugger is not None  # noqa: S101 - as above
        match message:
            case child_messages.Stop():
                if debugger.is_holding:
                    raise DebuggingEnded
                runner.stop()
                raise Ended
            case child_messages.Pause() if debugger.is_holding:
                self._channel.send(child_messages.Paused())  # a held tree is stopped already
            case child_messages.BeginRecording():
                self._recorder.begin(message.run, resets=message.resets)
            case child_messages.Pause():
                runner.pause()
                self._channel.send(child_messages.Paused())
            case child_messages.Resume():
                self._begin_s = None
                runner.resume()
                self._channel.send(child_messages.Resumed())
            case child_messages.StepTick():
                self._begin_s = None
                runner.step()
                self._guarded(lambda: runner.tick_due(self._graph.now()))
                self._reporter.flush(now=True)
                self._channel.send(child_messages.Stepped())
            case child_messages.SetTickRate():
                runner.set_tick_rate(message.tick_hz)
                self.note_input("set_tick_rate", {"tick_hz": message.tick_hz}, *debugger.place)
                self._channel.send(child_messages.Answer(request=message.request))
            case child_messages.SetPort():
                error = set_port(runner.tree, message, self._channel.send)
                if error is None:
                    self.note_input("set_port", done_by(message), *debugger.place)
                    self._recorder.changed()
                self._channel.send(child_messages.Answer(request=message.request, error=error))
            case child_messages.ApplyApplication():
                self._guarded(lambda: self._apply(message))
            case child_messages.SetBlackboard():
                self._channel.send(child_messages.BlackboardSet(self._set_blackboard(message)))
            case child_messages.ConnectDebugger():
                self._python_debugger.connect(message)
            case child_messages.TracePython(is_on=is_on):
                trace(is_on=is_on)
            case (
                child_messages.SetBreakpoints()
                | child_messages.Continue()
                | child_messages.ForceResult()
                | child_messages.ReleaseForced()
                | child_messages.MeasureNodes()
                | child_messages.ServeGroot2()
            ):
                self._inspect(debugger, message)

    def _inspect(
        self,
        debugger: ApplicationDebugger,
        message: DebuggerCommand | child_messages.MeasureNodes | child_messages.ServeGroot2,
    ) -> None:
        """Obeys a command of the debugger, of the profile or for Groot2, and answers it."""
        if isinstance(message, child_messages.MeasureNodes):
            assert self._profile is not None  # noqa: S101 - as above
            error = self._profile.obey(message.wanted)
        elif isinstance(message, child_messages.ServeGroot2):
            assert self._runner is not None  # noqa: S101 - as above
            error = self._groot.serve(self._runner.tree, message.port)
        elif isinstance(message, child_messages.SetBreakpoints) and message.request is None:
            debugger.start(message.wanted)  # nobody waits for a refusal
            error = None
        else:
            error = debugger.obey(message)
        self._channel.send(child_messages.Answer(request=message.request, error=error))

    def _report_hold_in_python(self, frame: FrameType) -> None:
        """Reports how far the tick has come in which the program will be held."""
        tree = self._runner.tree if self._runner is not None else None
        node = self._locator.node_of(frame)
        if tree is not None and tree.is_ticking and node is not None:
            self._reporter.held_in_python(tree, node)

    def _set_blackboard(self, message: child_messages.SetBlackboard) -> str:
        """Writes an entry; returns why that is not possible, or ""."""
        from executor.application.changes.written_entry import write  # noqa: PLC0415 - as all of the engine

        assert self._runner is not None  # noqa: S101 - as above
        if why := write(self._runner.tree, message.scope, message.key, message.value):
            return why
        self._reporter.written(self._runner.tree, message.scope, message.key)
        if self._debugger is not None:
            written = {"scope": message.scope, "key": message.key, "value": message.value}
            self.note_input("set_blackboard", written, *self._debugger.place)
        return ""

    def _apply(self, message: child_messages.ApplyApplication) -> None:
        """Replaces the running tree by a changed one, or says what would happen."""
        from executor.application.changes.applying import Applying  # noqa: PLC0415 - as all of the engine

        assert self._runner is not None  # noqa: S101 - commands come after `ready`
        assert self._program is not None  # noqa: S101 - as above
        with self._pulse.busy("loading"):
            applying = Applying(self._program, self._runner, self._graph.node, self._channel.send)
            applying.has_python_debugger = self._python_debugger.is_connected
            error = applying.run(Path(message.app_dir), self._follow, dry=message.dry)
        self._channel.send(child_messages.Answer(request=message.request, error=error))

    def _follow(self, tree: Tree) -> None:
        """Reports, records and debugs another tree from now on, which has taken over from the last one."""
        assert self._runner is not None  # noqa: S101 - as above
        self._runner.replace(tree)
        self._groot.follow(tree)
        tree.current = self._pulse.current
        self._locator.learn(tree)
        self._reporter.follow(tree)
        tree.observe(self._reporter.ticked)
        if self._debugger is not None:
            self._debugger.follow(tree)
            self.note_input("apply", {}, *self._debugger.place)
        if self._recorder is not None:
            self._recorder.follow(tree)
        if self._profile is not None:
            self._profile.follow(tree)

    def _redirect_output(self) -> None:
        from executor.application.console import Console  # noqa: PLC0415

        sys.stdout = Console("info", self._channel.send, self._locator, sys.__stdout__, self._now)
        sys.stderr = Console("error", self._channel.send, self._locator, sys.__stderr__, self._now)

    def _join(self, start: StartApplication) -> None:
        """Replaces the ROS graph that the spare joined, if the application needs another graph."""
        domain_id = self._graph.domain_id if start.domain_id is None else start.domain_id
        if not start.outside and domain_id == self._graph.domain_id:
            return
        from executor.application.ros import Graph  # noqa: PLC0415 - after the environment is set

        self._graph.close()  # first, since only one graph can have rclpy's default context
        self._graph = Graph(domain_id, self._on_clock, outside=start.outside)

    def _load(self, start: StartApplication) -> bool:
        from executor.application.locate import Place  # noqa: PLC0415

        try:
            tree = self._build(start)
            self._locator.learn(tree)
            tree.on_warning = self._reporter.tolerated
            self._reporter.tree(tree)
            self._reporter.stubs(tree)
            self._make_runner(tree, start)
        except BaseException as error:
            place = self._locator.place_of_error(error) if not isinstance(error, SystemExit) else Place()
            self._reporter.not_loaded(error, place)
            return False
        return True

    def _build(self, start: StartApplication) -> Tree:
        from executor.application.changes.program import Program  # noqa: PLC0415
        from executor.application.randomness import seed_randomness  # noqa: PLC0415

        self._program = Program(Path(start.app_dir), self._graph)
        if start.is_debugged:
            self._python_debugger.wait(self._commands)
        seed_randomness(start.seed)
        return self._program.load()

    def _make_runner(self, tree: Tree, start: StartApplication) -> None:
        from executor.application.debugging import ApplicationDebugger  # noqa: PLC0415
        from executor.application.profiling import ApplicationProfile  # noqa: PLC0415
        from executor.application.recording import ApplicationRecorder  # noqa: PLC0415
        from tree_gardener.runner import Runner  # noqa: PLC0415

        self._groot.follow(tree)
        if start.blackboard_json:
            self._restore(tree, start.blackboard_json)
        tree.setup(node=self._graph.node)
        self._runner = Runner(
            tree,
            tick_hz=start.tick_hz,
            on_finish=start.on_finish,
            on_error=start.on_error,
            finished=self._on_finished,
            fault=self._reporter.raised,
            halted=self._graph.node.commanded.stop,
        )
        self._debugger = ApplicationDebugger(self._runner, self._channel.send, self)
        self._reporter.take_held_s = self._debugger.take_held_s
        self._stops_held = start.outside
        self._debugger.start(start.breakpoints)
        tree.observe(self._reporter.ticked)
        self._recorder = ApplicationRecorder(tree, self._now, os.environ.pop(ADDRESS_VARIABLE, ""))
        self._profile = ApplicationProfile(tree, self._channel.send, self._recorder.profiled)
        self._debugger.leave_out = self._leave_out
        if start.profile is not None:
            self._profile.obey(start.profile)
        if start.groot2 and (refused := self._groot.serve(tree, start.groot2)) is not None:
            self._channel.send(child_messages.Log("warning", f"{refused.message} {refused.hint}"))
        tree.current = self._pulse.current
        self._runner.pause()

    def _restore(self, tree: Tree, blackboard_json: str) -> None:
        """Begins with a recorded blackboard; names what it cannot have."""
        from executor.application.changes.recorded_board import restore, said_of  # noqa: PLC0415 - with the engine

        empty = restore(tree, blackboard_json)
        self._reporter.restate(tree)
        if empty:
            self._channel.send(child_messages.Log("warning", said_of(empty), of_world=True))

    def _leave_out(self, held_s: float) -> None:
        if self._profile is not None and self._recorder is not None:
            self._profile.leave_out(held_s)
            self._recorder.leave_out(held_s)

    def _now(self) -> float:
        if self._begin_s is not None:
            return self._begin_s
        return self._graph.now()  # called through this object, since the graph may be replaced at the start

    def _on_clock(self, now_s: float) -> None:
        self._pulse.clocks += 1
        if self._runner is None:
            return
        if not self._is_connected:
            self._is_connected = self._has_connected()
        if self._is_connected:
            self._runner.tick_due(now_s)
            if self._debugger is not None:
                self._debugger.between_ticks()

    def _has_connected(self) -> bool:
        """Returns whether ticks may begin: all topics are connected, or the time for discovery is over."""
        if self._connect_by_s is None:
            self._connect_by_s = time.monotonic() + DISCOVERY_S
        return self._graph.is_connected() or time.monotonic() > self._connect_by_s

    def _guarded(self, work: Any) -> None:
        """Runs code of actions; reports each exception that it raises, and ends the run after it."""
        from executor.application.watchdog import Interrupted  # noqa: PLC0415
        from tree_gardener.debugging import DebuggingEnded  # noqa: PLC0415

        try:
            work()
        except Ended:
            raise
        except DebuggingEnded:
            raise Ended from None
        except Interrupted as interrupted:
            self._reporter.hangs(f"{interrupted.place} did not return and was interrupted", interrupted.place)
            self._end_broken("The tick did not return.")
        except (Exception, SystemExit) as error:
            assert self._runner is not None  # noqa: S101 - nothing of actions runs before
            self._runner.fail(error)
            raise Ended from None
        except BaseException as error:
            self._reporter.broke_out("exception", error, self._locator.place_of_error(error))
            self._end_broken("An action broke out of its tick.")

    def _end_broken(self, message: str) -> None:
        self._reporter.finished(None, "action_raised", message)
        raise Ended

    def _on_finished(self, status: Status) -> None:
        assert self._runner is not None  # noqa: S101 - it is what calls us
        error: TickError | None = self._runner.error
        if error is not None:
            self._reporter.finished(status, "action_raised", f"The run ended: {error.message}.")
        else:
            self._reporter.ended(status)
        raise Ended

    def _say_goodbye(self) -> None:
        """Halts the tree, so that actions release their resources."""
        assert self._runner is not None  # noqa: S101 - it ran
        self._groot.close()
        if self._debugger is not None:
            self._debugger.detach()
        try:
            self._runner.shutdown()
        except BaseException as error:
            self._reporter.broke_out("exception", error, self._locator.place_of_error(error))
        for stream in (sys.stdout, sys.stderr):
            stream.flush()


def main(arguments: list[str] | None = None) -> None:
    """Runs the application of a session of two processes."""
    parser = argparse.ArgumentParser(prog="python -m executor.application.process", description=__doc__)
    serve(Application, decode_to_application, parser, arguments)


if __name__ == "__main__":
    main()
