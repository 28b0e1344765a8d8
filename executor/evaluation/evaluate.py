"""Runs an evaluation with the pool of this machine, and stops where its rule says."""

from __future__ import annotations

import gc
import importlib
import os
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from executor.evaluation.pool.supervisor import Supervisor, threads_of_this_process
from executor.evaluation.run import run_cell
from executor.evaluation.summary import Summary, interval_of, stop_at
from executor.ros.environment import use_lockstep_environment

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from executor.evaluation.cluster.ray_pool import RayPool
    from executor.evaluation.outcome import Outcome
    from executor.evaluation.plan import Plan
    from executor.evaluation.pool.worker import Done

FIRST_LIMIT_S: Final = 60.0
"""The limit of the first run in s of processor time; at least twice its simulated time."""


TRACING_THREADS: Final = 2
"""LTTng's tracer, which `rclpy` is linked to, starts two threads when it is loaded. They wait for a tracing
daemon, hold no lock while they wait, and are not needed in a fork."""
LIBRARIES: Final = (
    "executor.application.locate",
    "executor.application.randomness",
    "executor.evaluation.run",
    "executor.headless.participants",
    "executor.headless.recorder",
    "executor.headless.recording",
    "executor.headless.waiting",
    "executor.navigation.node",
    "executor.navigation.start",
    "executor.render.choose",
    "executor.ros.default_context",
    "executor.ros.graph.mismatches",
    "executor.ros.node",
    "executor.ros.shared_topics",
    "executor.ros.spin",
    "executor.world.sensing.sensors",
    "numpy.random",
    "rclpy.action",
    "translator.package.app",
    "tree_gardener.ros_node",
    "tree_gardener.runner",
)
"""What every run imports; the parent of all runs has it loaded."""


MESSAGES: Final = (
    "builtin_interfaces.msg.Time",
    "geometry_msgs.msg.Twist",
    "nav_msgs.msg.Odometry",
    "rcl_interfaces.msg.ParameterEvent",
    "rosgraph_msgs.msg.Clock",
    "sensor_msgs.msg.LaserScan",
    "service_msgs.msg.ServiceEventInfo",
    "std_msgs.msg.Empty",
    "tf2_msgs.msg.TFMessage",
    "type_description_interfaces.msg.TypeDescription",
)
"""A message of each package whose native library every run loads with its first message."""


class ThreadsError(RuntimeError):
    """The process has threads of libraries, so that no worker can be forked of it."""


@dataclass
class Progress:
    """An evaluation while it runs."""

    wanted: int
    workers: int
    outcomes: dict[int, Outcome] = field(default_factory=dict)
    cpu_s: list[float] = field(default_factory=list)
    rss_bytes: int = 0
    began_s: float = field(default_factory=time.monotonic)
    is_stopped: bool = False

    def summary(self, seeds: Sequence[int], *, sequential: bool) -> Summary:
        """Returns the results so far."""
        done = tuple(self.outcomes[seed] for seed in sorted(self.outcomes))
        return Summary(done, self.wanted, sequential, stopped_early=sequential and len(done) < len(seeds))

    def estimate(self) -> str:
        """Returns a sentence that estimates the whole duration from the first run."""
        cpu_s, left = self.cpu_s[0], self.wanted - len(self.outcomes)
        return (
            f"a run takes about {cpu_s:.1f} s of a processor and {self.rss_bytes / 1e6:.0f} MB of memory; "
            f"the other {left} with {self.workers} at a time take about {duration(left * self.left_s_each())}"
        )

    def line(self, *, sequential: bool) -> str:
        """Returns the line of progress: how many runs, rate with its interval, and time left."""
        counted = [outcome for outcome in self.outcomes.values() if outcome.is_counted]
        successes = sum(outcome.is_success for outcome in counted)
        low, high = interval_of(successes, len(counted), sequential=sequential)
        rate = successes / len(counted) if counted else 0.0
        return (
            f"{len(self.outcomes)} of {self.wanted}  success {rate:.1%} ({low:.1%} to {high:.1%})  "
            f"{duration(self.left_s)} left"
        )

    def left_s_each(self) -> float:
        """Returns the real time in s that each further run probably takes, if the processors are free."""
        return (time.monotonic() - self.began_s) / max(1, len(self.cpu_s)) / self.workers

    @property
    def left_s(self) -> float:
        """The real time that is probably left, in s, by the mean of the runs so far."""
        done = len(self.cpu_s)
        elapsed_s = time.monotonic() - self.began_s
        return elapsed_s / done * max(0, self.wanted - len(self.outcomes)) if done else 0.0


class Interrupted(Exception):  # noqa: N818 - it is no error
    """Ctrl+C ended the evaluation; `progress` holds the finished runs."""

    def __init__(self, progress: Progress) -> None:
        super().__init__("interrupted")
        self.progress = progress


def duration(seconds: float) -> str:
    """Returns a length of time in words."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


def load_libraries() -> None:
    """Loads the libraries that every run needs, into the parent of all runs. It opens nothing.

    Raises:
        ThreadsError: a library has started a thread.
    """
    use_lockstep_environment()
    for name in LIBRARIES:
        importlib.import_module(name)
    supports = importlib.import_module("rclpy.type_support")
    for name in MESSAGES:
        package, _, message = name.rpartition(".")
        supports.check_for_type_support(getattr(importlib.import_module(package), message))
    importlib.import_module("executor.application.host").prepare()
    importlib.import_module("cv2").setNumThreads(1)
    gc.collect()
    gc.freeze()
    count = threads_of_this_process()
    if count > 1 + TRACING_THREADS:
        raise ThreadsError(f"a library has started threads, {count} in all; workers cannot be forked")


def evaluate(  # noqa: PLR0913 - an evaluation, where it runs, and who listens
    plan: Plan,
    seeds: Sequence[int],
    *,
    workers: int | None = None,
    cluster: str | None = None,
    kept: Iterable[Outcome] = (),
    told: Callable[[Progress, Done | None], None] = lambda _p, _d: None,
) -> Progress:
    """Runs the seeds of an evaluation that have no outcome yet.

    With `until`, it ends as soon as the runs in the order of their seeds are enough, and outcomes beyond that
    seed are dropped, so that the number of workers changes nothing.

    Args:
        plan: the evaluation.
        seeds: the seeds, in order.
        workers: the number of workers; without it, one a processor.
        cluster: the address of a Ray cluster that runs them in place of this machine.
        kept: outcomes that are known already.
        told: called at the start, and with each run that has ended.

    Raises:
        ThreadsError: this process has several threads.
        ClusterError: there is no such cluster, or it cannot run the evaluation.
        Interrupted: Ctrl+C ended it.
    """
    if cluster is None:
        load_libraries()
    count = workers or len(os.sched_getaffinity(0))
    evaluation = plan.evaluation
    known = {outcome.seed: outcome for outcome in kept if outcome.seed in set(seeds)}
    progress = Progress(len(seeds), count, known)
    left = [seed for seed in seeds if seed not in known]
    told(progress, None)

    def end() -> bool:
        if evaluation.until is None:
            return False
        prefix: list[bool] = []
        for seed in seeds:
            if seed not in progress.outcomes:
                break
            prefix.append(progress.outcomes[seed].is_success)
        runs = stop_at(prefix, evaluation.until)
        if runs is None:
            return False
        wanted = set(seeds[:runs])
        progress.outcomes = {seed: found for seed, found in progress.outcomes.items() if seed in wanted}
        progress.wanted = runs
        progress.is_stopped = runs < len(seeds)
        return True

    def hear(done: Done) -> bool:
        progress.outcomes[done.outcome.seed] = done.outcome
        progress.cpu_s.append(done.cpu_s)
        progress.rss_bytes = max(progress.rss_bytes, done.rss_bytes)
        is_over = end()
        told(progress, done)
        return not is_over

    if left and not end():
        pool = supervisor_of(plan, min(count, len(left))) if cluster is None else _cluster_of(plan, cluster)
        with pool:
            try:
                pool.run(left, hear)
            except KeyboardInterrupt:
                raise Interrupted(progress) from None
    return progress


def supervisor_of(plan: Plan, workers: int) -> Supervisor:
    """Returns the pool of this machine."""
    return Supervisor(
        lambda seed: run_cell(plan, seed), workers, first_limit_s=_first_limit_s(plan), scale=_scale_of(plan)
    )


def _cluster_of(plan: Plan, address: str) -> RayPool:
    from executor.evaluation.cluster.parcel import pack  # noqa: PLC0415 - it needs this module
    from executor.evaluation.cluster.ray_pool import RayPool  # noqa: PLC0415 - as above

    return RayPool(pack(plan), address, first_limit_s=_first_limit_s(plan), scale=_scale_of(plan))


def _first_limit_s(plan: Plan) -> float:
    return max(FIRST_LIMIT_S, 2 * plan.evaluation.duration_s)


def _scale_of(plan: Plan) -> Callable[[Outcome], float]:
    """Returns by what the cost of a run is multiplied that ended early."""
    return lambda outcome: max(1.0, plan.evaluation.duration_s / max(outcome.end_s, 0.1))
