"""World, tree and actions in one process: `python -m executor.exact.process --channel-fd N`.

The process is the application of an exact session (`executor.application.process`), with its world in it. It
takes the world over from the process that shows it while no application runs, and gives its state back at the
end. The main thread does all of it, in the order of a lock-step run; the thread that listens only queues.
"""

from __future__ import annotations

import argparse
import contextlib
import logging
import os
import queue
import sys
import time
from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor import child_messages, messages
from executor.application.host import serve
from executor.application.process import GOODBYE_S, SPIN_S, Application, Ended
from executor.child_messages import decode_to_exact
from executor.exact.fingerprints import Fingerprints
from executor.exact.gate import Gate
from executor.exact.graph import ExactGraph
from executor.exact.keeping import Keeping
from executor.exact.line_tracer import LineTracer
from executor.exact.outlines import outlines_of
from executor.exact.replaying import NotThereError, Replaying
from executor.exact.slow_ticks import SlowTicks
from executor.exact.trial import Trial, Witness
from executor.exact.trying import Trying, most_at_once
from executor.recorder.link import ADDRESS_VARIABLE
from executor.replay_messages import FINGERPRINT_BYTES, Input
from executor.ros.environment import lockstep_environment
from executor.run_inputs import input_of, noted
from executor.world.commands import WorldCommands
from tree_gardener.debugging import DebuggingEnded
from tree_gardener.errors import describe
from tree_gardener.runner import RunnerState

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.application.report import Report
    from executor.application.ros import ApplicationGraph
    from executor.child_messages import StartApplication, ToExact
    from executor.exact.snapshots import Woken
    from executor.exact.trying import Change
    from executor.exact.world import ExactWorld
    from executor.replay_messages import Replay
    from executor.supervision.channel import Channel
    from executor.supervision.pulse import Pulse
    from tree_gardener import Tree

__all__ = ["ExactApplication", "main"]

TOLD_S: Final = 0.5
"""The time between two messages with fingerprints."""
ENDED: Final = "The run ended on the way, which it did not the first time: it is not repeatable."


class ExactApplication(Application):
    """Loads one application into a world of its own, runs both, and reports how they ended."""

    def __init__(self, channel: Channel[Any, Any], pulse: Pulse) -> None:
        self._exact_graph = ExactGraph()
        gate: Any = Gate(channel)
        self._gate: Gate = gate
        self._send = gate.send
        self._socket = channel
        self._keeping = Keeping(gate.send)
        super().__init__(gate, pulse)
        self._for_world = WorldCommands(gate.send, pulse)
        self._exact: ExactWorld | None = None
        self._fingerprints: Fingerprints | None = None
        self._prints = bytearray()
        self._prints_due_s = 0.0
        self._replaying: Replaying | None = None
        self._failure: NotThereError | None = None
        self._is_in_tick = False
        self._is_handed_over = False
        self._is_copy = False
        self._is_trial = False
        self._tracer: LineTracer | None = None
        self._known_after = b""
        """The fingerprints of what followed, the first time, the moment up to which it was made again."""
        pulse.locate = SlowTicks(pulse.locate, self._is_waited_for, gate.send)
        _warm_up()

    def _make_graph(self) -> ApplicationGraph:
        return self._exact_graph

    def _join(self, start: StartApplication) -> None:
        """Does nothing: the graph is made with the world."""

    def _build(self, start: StartApplication) -> Tree:
        from executor.exact.world import ExactWorld  # noqa: PLC0415 - slow to load

        self._exact = exact = ExactWorld(
            start,
            tick=self._tick,
            is_ticking=self._is_running,
            send=self._send,
            commands=self._for_world,
            recorder=os.environ.get(ADDRESS_VARIABLE, ""),
        )
        exact.loop.moved = self._moved
        exact.loop.rests_after_tick = self._is_snapshot_due
        exact.loop.watchers.append(self._look_at_tree)  # together with those of the world
        self._exact_graph.join(exact.world, exact.ros)
        self._fingerprints = Fingerprints(exact.world)
        self._keeping.begin()
        tree = super()._build(start)
        self._fingerprints.follow(tree)
        if start.replay is not None:
            self._gate.close_for_replay()  # what is printed while it loads was printed the first time
        return tree

    def _follow(self, tree: Tree) -> None:
        super()._follow(tree)
        if self._fingerprints is not None:
            self._fingerprints.follow(tree)

    def _catch_up(self, start: StartApplication) -> bool:
        return start.replay is None or self._replay(start.replay)

    def _work(self) -> None:
        loop = self._loop
        if self._is_snapshot_due():
            self._snapshot()
        loop.run_due(time.monotonic())
        if self._prints and time.monotonic() >= self._prints_due_s:
            self._tell_fingerprints()
        wait_s = loop.next_due_s(time.monotonic())
        if wait_s > 0:
            self._graph.spin_once(min(wait_s, SPIN_S))

    def _obey(self, message: ToExact) -> None:
        if (command := input_of(message)) is not None and self._replaying is None:
            self._enter(message, command)
        match message:
            case child_messages.ForWorld(command=command):
                self._for_world.answering(command, lambda: self._for_world.obey(command))
            case child_messages.StepTick():
                self._guarded(self._step)
                self._tell_fingerprints()
                self._reporter.flush(now=True)
                self._channel.send(child_messages.Stepped())
            case child_messages.SetTickRate(tick_hz=tick_hz):
                self._loop.set_tick_rate(tick_hz)
                super()._obey(message)
            case child_messages.Pause():
                self._tell_fingerprints()
                super()._obey(message)
            case child_messages.BeginRecording(run=run) if self._recorder is not None:
                self._recorder.begin(run)  # after a reset, the time has gone back already
            case child_messages.KeepSnapshots(is_on=is_on):
                self._keeping.is_on = is_on
            case child_messages.TakeSnapshot() if self._is_in_tick:
                self._send(child_messages.NoSnapshots("it is held within a tick", is_wanted=True))
            case child_messages.TakeSnapshot():
                self._snapshot(is_wanted=True)
            case child_messages.TryMany():
                self._try_many(message)
            case child_messages.Awake():
                pass  # only for a copy that waits for it
            case _:
                super()._obey(message)

    def serve_held(self) -> None:
        """Obeys the session while the tree is held; views still get their frames."""
        if self._is_trial:
            raise DebuggingEnded  # nobody is there to continue it
        if self._replaying is not None:
            self._serve_held_again(self._replaying)
            return
        super().serve_held()
        now_s = time.monotonic()
        self._loop.streams.send_due(now_s)
        self._exact_world.recorder.look(now_s)

    def show_held(self) -> None:
        """Reports what the tick in progress has written so far, and the ticks before it."""
        if self._replaying is None:
            self._tell_fingerprints()  # the session counts the ticks that have ended
        super().show_held()

    def note_input(self, command: str, data: Any, tick: int, hook: int) -> None:
        """Records what a person did, unless it is done again."""
        if self._replaying is None:
            super().note_input(command, data, tick, hook)

    def _report(self, message: Report) -> None:
        if isinstance(message, child_messages.Finished) and self._replaying is None:
            self._tell_fingerprints()
            self._hand_over()  # the session drops this process when the run has finished
        super()._report(message)

    def _say_goodbye(self) -> None:
        self._tell_fingerprints()
        super()._say_goodbye()
        self._hand_over()

    def close(self) -> None:
        """Sends the last messages."""
        if self._is_copy:
            self._exact_world.flush()  # a copy must not destroy what it has in the graph
        elif self._exact is not None:
            self._exact.close()
        super().close()

    @property
    def _exact_world(self) -> ExactWorld:
        assert self._exact is not None  # noqa: S101 - it is built before anything runs
        return self._exact

    @property
    def _loop(self) -> Any:
        return self._exact_world.loop

    def _moved(self, clocks: int) -> None:
        self._pulse.clocks = clocks
        self._pulse.moved()

    def _look_at_tree(self, _: float) -> None:
        """Sends the recorder what the tree did up to the moment up to which it has the world."""
        if self._recorder is not None:
            self._recorder.pump()

    def _is_running(self) -> bool:
        return self._runner is not None and self._runner.state is RunnerState.RUNNING

    def _is_waited_for(self) -> bool:
        is_held = self._debugger is not None and self._debugger.is_holding
        return self._is_in_tick and not (is_held or self._python_debugger.is_connected)

    def _tick(self) -> None:
        """Runs the callbacks of the actions, then the tick that is due."""
        runner, exact = self._runner, self._exact_world
        assert runner is not None  # noqa: S101 - time passes only after `ready`
        self._pulse.moved()
        self._pulse.ticks = exact.loop.ticks
        if self._python_debugger.is_connected:
            self._tell_fingerprints()  # at a line of Python this thread tells nothing
        self._is_in_tick = True
        if self._replaying is not None and runner.state is RunnerState.PAUSED:
            runner.resume()  # pauses are not made again
        tracer = self._tracer if self._replaying is not None and self._replaying.is_at_moment else None
        try:
            with tracer or contextlib.nullcontext():
                exact.ros.executor.drain()
                if tracer is not None:
                    tracer.is_in_tick = True
                runner.tick_now()
        finally:
            self._is_in_tick = False
        if self._fingerprints is not None and self._replaying is None:
            self._prints += self._fingerprints.take()
        if self._debugger is not None:
            self._debugger.between_ticks()

    def _step(self) -> None:
        """Ticks once, and stays paused: the tick is the one that a run without a pause would make now."""
        runner = self._runner
        assert runner is not None  # noqa: S101 - as above
        number = runner.tree.tick_number
        runner.resume()
        try:
            while runner.tree.tick_number == number and not runner.is_finished:
                self._loop.tick()
        finally:
            runner.pause()

    def _enter(self, message: ToExact, command: Any) -> None:
        """Notifies the session, and the recording, of what changes the run, and of its place."""
        loop, debugger = self._loop, self._debugger
        assert debugger is not None  # noqa: S101 - commands come after `ready`
        tick, hook = debugger.place
        data = msgspec.msgpack.encode(message)
        self._keeping.inputs += 1
        self._keeping.resets += isinstance(command, child_messages.Reset)
        self._send(child_messages.Entered(Input(loop.ticks, loop.step_number, hook, data)))
        if (done := noted(command)) is not None:
            self.note_input(child_messages.name_of(command), done, tick, hook)

    def _tell_fingerprints(self) -> None:
        self._prints_due_s = time.monotonic() + TOLD_S
        if self._prints:
            self._send(child_messages.Fingerprints(bytes(self._prints)))
            self._prints.clear()

    def _is_snapshot_due(self) -> bool:
        return self._keeping.is_due(self._loop, draws=bool(self._exact_world.renderer_name))

    def _snapshot(self, *, is_wanted: bool = False) -> None:
        """Makes a snapshot; in a copy of it, this continues when the manager has woken it."""
        self._tell_fingerprints()
        renderer = self._exact_world.renderer_name
        woken = self._keeping.take(self._loop, renderer, is_wanted=is_wanted)
        if woken is not None:
            self._continue_as_copy(woken)

    def _continue_as_copy(self, woken: Woken) -> None:
        """Makes the run again from this snapshot up to a moment, and pauses there."""
        exact, runner = self._exact_world, self._runner
        assert runner is not None  # noqa: S101 - it ran
        self.pid, self._is_copy = os.getpid(), True
        self._commands = queue.SimpleQueue()
        self._exact_graph.renew()
        self._socket.reopen(woken.channel_fd)
        self._pulse.restart(woken.notes_fd)
        runner.tree.current = self._pulse.current
        exact.loop.pause()
        exact.forget_clients()
        self._gate.close_for_replay()
        self._channel.send(child_messages.Starting())
        self._start_listener()
        with self._pulse.busy("loading"):
            while not isinstance(awake := self._commands.get(), child_messages.Awake):
                pass
            exact.loop.set_speed(awake.speed)
            is_there = self._replay(awake.replay)
        if self._recorder is not None:
            self._recorder.pump()  # ticks that were recorded the first time
        if not is_there:
            self._channel.flush(GOODBYE_S)
            os._exit(0)
        self._channel.send(child_messages.ApplicationReady())

    def _try_many(self, message: child_messages.TryMany) -> None:
        """Continues the run once for each change, in copies; it stays where it is itself."""
        exact = self._exact_world
        if reason := self._keeping.refusal(exact.renderer_name):
            text = f"Values cannot be tried in this run: {reason}."
            self._send(child_messages.TryingEnded(message.job, "refused", text))
            return
        outlines = outlines_of(exact.world.scene, exact.world.read_poses()())
        started = child_messages.TryingStarted(message.job, self._loop.time_s, most_at_once(), outlines)
        self._send(started)

        def continue_with(
            index: int, change: Change | None, tell: Callable[[float], None]
        ) -> child_messages.TryOutcome:
            self._is_trial = True
            return self._continued(message, index, change, tell)

        Trying(
            message.job,
            message.changes,
            send=self._send,
            moved=self._pulse.moved,
            continue_with=continue_with,
        ).run()

    def _continued(
        self,
        message: child_messages.TryMany,
        index: int,
        change: Change | None,
        tell: Callable[[float], None],
    ) -> child_messages.TryOutcome:
        """Continues the run in a copy that has no session, and returns what happened."""
        exact, loop, runner = self._exact_world, self._loop, self._runner
        assert runner is not None  # noqa: S101 - it ran
        self._exact_graph.renew()
        self._commands = queue.SimpleQueue()
        witness = Witness()
        self._gate.lead_to(witness)
        self._prints.clear()
        super()._obey(child_messages.SetBreakpoints(wanted=messages.SetBreakpoints([], on=False)))
        if isinstance(change, child_messages.NewSeed):
            exact.reseed(change.seed)
        elif change is not None:
            super()._obey(change)
        trial = Trial(exact.world, loop, lambda: runner.tree, witness, tell)
        loop.set_speed(0)
        runner.resume()
        if not witness.refusal:
            with contextlib.suppress(Ended):
                self._guarded(lambda: trial.run(message.duration_s))
        self._tell_fingerprints()
        return trial.outcome(message.job, index, self._known_after)

    def _replay(self, replay: Replay) -> bool:
        """Makes an earlier run again up to a moment, and pauses there; returns whether that is possible."""
        exact, loop, runner = self._exact_world, self._loop, self._runner
        assert runner is not None  # noqa: S101 - it is loaded
        assert self._fingerprints is not None  # noqa: S101 - as above
        self._replaying = Replaying(
            replay,
            loop,
            obey=self._obey,
            send=self._send,
            fingerprint=self._fingerprints.take,
            given=self._keeping.inputs,
            resets=self._keeping.resets,
        )
        if replay.shows_source and self._program is not None:
            self._tracer = LineTracer(self._locator, self._program)
        speed = loop.speed
        loop.set_speed(0)
        error = ""
        try:
            reached = self._replaying.run()
        except NotThereError as lost:
            error = f"{lost}."
        except BaseException as raised:
            error = f"{self._failure}." if self._failure is not None else _ended(raised)
        finally:
            self._replaying = None
            self._gate.open()
        if self._tracer is not None and self._tracer.has_run:
            self._send(self._tracer.source(loop.time_s, runner.tree.tick_number))
            return False  # the process has nothing more to do
        if error:
            hint = "Go back to an earlier moment, or press Run."
            self._channel.send(child_messages.Fault("load", error, hint))
            return False
        loop.set_speed(speed)
        self._known_after = replay.fingerprints[reached.ticks * FINGERPRINT_BYTES :]
        self._keeping.inputs, self._keeping.resets = reached.inputs, reached.resets
        runner.pause()
        exact.world.take_collisions()  # they were sent the first time
        exact.ros.node.take_notes()
        self._reporter.restate(runner.tree)
        self._gate.send_state()
        self._send(reached)
        return True

    def _serve_held_again(self, replaying: Replaying) -> None:
        """Gives what entered at this stop of the debugger the first time."""
        assert self._debugger is not None  # noqa: S101 - it holds
        try:
            replaying.held(self._debugger.place[1])
        except NotThereError as lost:
            self._failure = lost
            raise DebuggingEnded from None

    def _hand_over(self) -> None:
        """Stops the robots, and gives the state of the world back, once."""
        if self._exact is None or self._is_handed_over:
            return
        self._is_handed_over = True
        self._loop.stop_robots()
        self._send(child_messages.WorldState(data=self._exact.world.dump()))


def _ended(error: BaseException) -> str:
    return f"{ENDED} {describe(error)}" if str(error) else ENDED


def _warm_up() -> None:
    """Loads modules in advance, so that `start` does not have to wait for them."""
    from executor.exact import world  # noqa: F401, PLC0415 - ROS reads the environment when it is loaded
    from executor.world.physics import bullet  # noqa: F401, PLC0415 - slow to load


def main(arguments: list[str] | None = None) -> None:
    """Runs an exact application for the manager."""
    log = logging.getLogger("executor")
    log.addHandler(logging.StreamHandler(sys.stderr))  # before it is replaced: this is no output of actions
    log.propagate = False
    serve(
        ExactApplication,
        decode_to_exact,
        argparse.ArgumentParser(prog="python -m executor.exact.process", description=__doc__),
        arguments,
        environment=lockstep_environment(),
    )


if __name__ == "__main__":
    main()
