"""Ticks a tree at a fixed rate.

The runner owns no thread and no clock: its caller passes the time to `tick_due`, as often as it likes. All
commands take effect at the boundary between two ticks.
"""

import dataclasses
import enum
import time
from collections.abc import Callable
from typing import Final

from tree_gardener import users_nodes
from tree_gardener.errors import CallbackError, TickError
from tree_gardener.status import RUNNING, Status
from tree_gardener.tree import Tree


class RunnerState(enum.Enum):
    """The states of a runner."""

    RUNNING = "running"
    PAUSED = "paused"
    FINISHED = "finished"


@dataclasses.dataclass(frozen=True)
class Overrun:
    """A tick that took longer than its period.

    Attributes:
        tick: the number of the tick.
        duration_s: the duration of the tick.
        period_s: the time that a tick may take.
        missed: ticks that were skipped because of it.
        slow_uid: the action that took most of the time; 0 if none was ticked.
        slow_s: the time that this action took.
    """

    tick: int
    duration_s: float
    period_s: float
    missed: int
    slow_uid: int
    slow_s: float


@dataclasses.dataclass
class RunStatistics:
    """A runner's counts: ticks, overruns, skipped ticks, and the longest tick."""

    ticks: int = 0
    overruns: int = 0
    missed: int = 0
    longest_s: float = 0.0
    total_s: float = 0.0


OnFinish = Callable[[Status], None]
OnFault = Callable[[TickError], None]
OnOverrun = Callable[[Overrun], None]

ON_FINISH: Final = ("stop", "repeat")
ON_ERROR: Final = ("stop", "failure")


class Runner:
    """Ticks a tree at a fixed rate.

    Args:
        tree: the tree, after `setup()`.
        tick_hz: the number of ticks per second.
        on_finish: ``stop`` ends the run when the root succeeds, fails or is skipped; ``repeat`` continues.
        on_error: ``stop`` ends the run when an action raises; ``failure`` makes that node fail.
        finished: called once with the root's last status when the run ends by itself.
        fault: called with each error.
        halted: called each time the tree was halted, to stop what it moved.
        overrun: called after each tick that took longer than its period; only with it are actions measured.
        measure: returns a time in seconds that measures the duration of ticks; it does not determine when
            ticks are due.
    """

    def __init__(  # noqa: PLR0913 - all by keyword
        self,
        tree: Tree,
        *,
        tick_hz: float,
        on_finish: str = "stop",
        on_error: str = "stop",
        finished: OnFinish | None = None,
        fault: OnFault | None = None,
        halted: Callable[[], None] | None = None,
        overrun: OnOverrun | None = None,
        measure: Callable[[], float] = time.perf_counter,
    ) -> None:
        if on_finish not in ON_FINISH:
            raise ValueError(f"on_finish is {on_finish!r}, not one of {', '.join(ON_FINISH)}")
        if on_error not in ON_ERROR:
            raise ValueError(f"on_error is {on_error!r}, not one of {', '.join(ON_ERROR)}")
        self.tree = tree
        self.period_s = _period(tick_hz)
        self.repeats = on_finish == "repeat"
        self.state = RunnerState.RUNNING
        self.status = Status.IDLE
        self.error: TickError | None = None
        self.statistics = RunStatistics()
        self._finished = finished
        self._fault = fault
        self._halted = halted
        self._overrun = overrun
        self._measure = measure
        self._due_s: float | None = None
        self._steps = 0
        self._wanted_state: RunnerState | None = None
        self._wanted_period_s: float | None = None
        self._stop_wanted = False
        self._in_tick = False
        tree.on_error = self._tell if on_error == "failure" else None
        self._watch_leaves()

    @property
    def is_finished(self) -> bool:
        """Whether the run is over."""
        return self.state is RunnerState.FINISHED

    def pause(self) -> None:
        """Pauses until `resume` or `step`."""
        self._wanted_state = RunnerState.PAUSED
        self._settle()

    def resume(self) -> None:
        """Continues; after a pause, at the earliest one period after the next call of `tick_due`."""
        self._wanted_state = RunnerState.RUNNING
        self._settle()

    def step(self, count: int = 1) -> None:
        """Requests `count` ticks of a paused runner."""
        self._steps += count

    def set_tick_rate(self, tick_hz: float) -> None:
        """Changes the rate, from the next tick on."""
        self._wanted_period_s = _period(tick_hz)
        self._settle()

    def stop(self) -> None:
        """Ends the run and halts the tree, so that robots stop."""
        self._stop_wanted = True
        self._settle()

    def replace(self, tree: Tree) -> None:
        """Ticks another tree from now on, which has taken over from the present one; between two ticks."""
        tree.on_error = self.tree.on_error
        self.tree = tree
        self._watch_leaves()

    def tick_due(self, now_s: float) -> Status | None:
        """Ticks the tree once if a tick is due; returns the root's status, or None if there was no tick.

        Args:
            now_s: the time; simulated time where there is one. After a jump back, the next tick is due
                immediately.
        """
        self._settle()
        if self.state is RunnerState.FINISHED or not self._is_due(now_s):
            return None
        return self._tick()

    def tick_now(self) -> Status | None:
        """Ticks the tree once; returns the root's status, or None while paused or after the end.

        The caller determines when ticks are due, as where the world counts its steps.
        """
        self._settle()
        if self.state is RunnerState.FINISHED or (
            self.state is RunnerState.PAUSED and not self._takes_step()
        ):
            return None
        return self._tick()

    def fail(self, error: BaseException) -> None:
        """Ends the run after an exception outside of a tick, such as that of a callback."""
        located = CallbackError.of(error)
        if self.is_finished:
            self._tell(located)
        else:
            self._fail(located)

    def shutdown(self) -> None:
        """Ends the run and shuts the tree down."""
        if not self.is_finished:
            self.state = RunnerState.FINISHED
            self._halt()
        self.tree.shutdown()

    def _tick(self) -> Status | None:
        start_s = self._measure()
        self._in_tick = True
        try:
            status = self.tree.tick_exactly_once()
        except TickError as error:
            users_nodes.end_broken(self.tree.nodes, error)
            self._fail(error)
            return None
        finally:
            self._in_tick = False
            self._account(self._measure() - start_s)
        self.status = status
        if (fault := self.tree.fault) is not None:
            self._fail(fault)
            return None
        if status is not RUNNING and not self.repeats:
            self._end(status)
        self._settle()
        return status

    def _takes_step(self) -> bool:
        """Whether a tick was requested during the pause; it is used up."""
        if self._steps == 0:
            return False
        self._steps -= 1
        return True

    def _watch_leaves(self) -> None:
        if self._overrun is not None:
            self.tree.time_leaves()
        else:
            self.tree.mark_leaves()  # a hung action must be named, and nobody asks for the slowest one

    def _is_due(self, now_s: float) -> bool:
        if self.state is RunnerState.PAUSED:
            self._due_s = None
            return self._takes_step()
        due_s = self._due_s
        if due_s is not None and now_s < due_s - 1e-9 and due_s - now_s <= self.period_s + 1e-9:
            return False
        if due_s is None or now_s < due_s:
            due_s = now_s
        # Missed ticks are skipped, not caught up: a burst of ticks would command the robot with old data.
        late = int((now_s - due_s) / self.period_s + 1e-9)
        self.statistics.missed += late
        self._due_s = due_s + (late + 1) * self.period_s
        return True

    def _account(self, duration_s: float) -> None:
        statistics = self.statistics
        statistics.ticks += 1
        statistics.total_s += duration_s
        statistics.longest_s = max(statistics.longest_s, duration_s)
        if duration_s > self.period_s:
            statistics.overruns += 1
            if self._overrun is not None:
                slow_s, slow_uid = self.tree.slowest
                missed = int(duration_s / self.period_s)
                self._overrun(
                    Overrun(self.tree.tick_number, duration_s, self.period_s, missed, slow_uid, slow_s)
                )

    def _settle(self) -> None:
        """Executes the commands, unless a tick is in progress."""
        if self._in_tick or self.state is RunnerState.FINISHED:
            return
        if self._wanted_period_s is not None:
            if self._due_s is not None:
                self._due_s += self._wanted_period_s - self.period_s
            self.period_s, self._wanted_period_s = self._wanted_period_s, None
        if self._wanted_state is not None:
            self.state, self._wanted_state = self._wanted_state, None
            self._steps = 0
        if self._stop_wanted:
            self.state = RunnerState.FINISHED
            self._halt()

    def _end(self, status: Status) -> None:
        self.state = RunnerState.FINISHED
        self._halt()
        if self._finished is not None:
            self._finished(status)

    def _fail(self, error: TickError) -> None:
        self.error = error
        self.tree.fault = None
        self._tell(error)
        self.status = Status.FAILURE
        self._end(Status.FAILURE)

    def _halt(self) -> None:
        try:
            self.tree.halt()
        except TickError as error:
            self.error = self.error or error
            self._tell(error)
            users_nodes.halt_one_by_one(self.tree.nodes)
        if self._halted is not None:
            self._halted()

    def _tell(self, error: TickError) -> None:
        if self._fault is not None:
            self._fault(error)


def _period(tick_hz: float) -> float:
    if not tick_hz > 0:
        raise ValueError(f"the tick rate is {tick_hz} Hz and must be more than 0")
    return 1.0 / tick_hz
