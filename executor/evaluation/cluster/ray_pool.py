"""Runs seeds on a Ray cluster, with the interface of the pool of one machine.

Scheduling, the repetition after the loss of a node, autoscaling and transport are Ray's. The parcel goes once
into the object store; a task is a batch of seeds.
"""

from __future__ import annotations

import os
import re
import secrets
import socket
import sys
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

from executor.evaluation.cluster.batch import Batch, run_batch
from executor.evaluation.fingerprint import differences, fingerprint
from executor.evaluation.outcome import LOST, Outcome
from executor.evaluation.pool.supervisor import LEAST_LIMIT_S, LIMIT_FACTOR, MOST_TRIES
from executor.evaluation.pool.worker import Done, Limits

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

BATCH_S: Final = 30.0
"""The processor time of a batch; a shorter one would be mostly the start of its supervisor."""
STORE_BYTES: Final = 200 << 20
# Ray waits 30 s for a node, in two places; on a busy machine it starts later. Only one can be set.
NODE_START_S: Final = "120"
NODE_STARTS: Final = 4
LATE: Final = "timed out during startup"
AUTO: Final = "auto"
NOTED: Final = Path("/tmp/ray/ray_current_cluster")  # noqa: S108 - where Ray keeps it
REACH_S: Final = 5.0
_HOST_PORT: Final = re.compile(r"(?:ray://)?\[?([^\[\]/]+?)\]?:(\d{1,5})")
MISSING: Final = (
    "--cluster needs Ray, which is not installed: {python} -m pip install 'ray~=2.60' (the extra `cluster`)"
)
STALE: Final = f" (if the cluster that {NOTED} names is gone, `ray stop` removes that note)"


T = TypeVar("T")


class ClusterError(RuntimeError):
    """The evaluation cannot run on the cluster; the text says why."""


def import_ray(*, is_own: bool) -> Any:
    """Returns Ray, which reads its environment when it is loaded.

    Args:
        is_own: whether this process starts a cluster; others must not reach it.

    Raises:
        ClusterError: it is not installed.
    """
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    os.environ.setdefault("RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO", "0")
    os.environ.setdefault("RAY_worker_niceness", "0")
    os.environ.setdefault("RAY_raylet_start_wait_time_s", NODE_START_S)
    if is_own and "ray" not in sys.modules:
        os.environ["RAY_AUTH_MODE"] = "token"
        os.environ["RAY_AUTH_TOKEN"] = secrets.token_hex(32)
    try:
        import ray  # noqa: PLC0415 - an extra
    except ImportError:
        raise ClusterError(MISSING.format(python=sys.executable)) from None
    return ray


class RayPool:
    """Runs seeds in batches on a cluster; use it as a context manager.

    Args:
        parcel: the evaluation (`parcel.pack`).
        address: the address of a cluster; `auto` is the one of this machine, and starts one if there is none.
        first_limit_s: the limit of processor time of the first run.
        scale: by what the cost of the first run is multiplied, for a run that takes the whole time.

    Raises:
        ClusterError: there is no such cluster, or Ray is not installed.
    """

    def __init__(
        self, parcel: bytes, address: str, *, first_limit_s: float, scale: Callable[[Outcome], float]
    ) -> None:
        self._mine = fingerprint()
        self._is_own = address == AUTO and not has_cluster()
        self._ray = import_ray(is_own=self._is_own)
        self._parcel = parcel
        self._address = address
        self._limits = Limits(first_limit_s)
        self._scale = scale
        self._tries: dict[int, int] = {}
        self._cost_s = BATCH_S

    def __enter__(self) -> RayPool:
        connect(self._ray, None if self._is_own else self._address)
        ray = self._ray
        self._remote = ray.remote(num_cpus=1, max_retries=MOST_TRIES - 1)(run_batch)
        self._stored = ray.put(self._parcel)
        return self

    def __exit__(self, *_: object) -> None:
        self._ray.shutdown()

    def run(self, seeds: Iterable[int], told: Callable[[Done], bool]) -> None:
        """Runs seeds; the first one runs alone, since its cost gives the limit and the size of the batches.

        Args:
            seeds: the seeds.
            told: called with each run that has ended; returns whether the others are still wanted.

        Raises:
            ClusterError: a node has another platform.
        """
        left = list(seeds)

        def first(done: Done) -> bool:
            self._cost_s = max(0.01, done.cpu_s * self._scale(done.outcome))
            self._limits = Limits(max(LEAST_LIMIT_S, LIMIT_FACTOR * min(self._cost_s, self._limits.cpu_s)))
            return told(done)

        if self._run_batches([left[:1]], first):
            size = max(1, round(BATCH_S / self._cost_s))
            size = min(size, max(1, -(-len(left[1:]) // _processors(self._ray))))
            rest = left[1:]
            self._run_batches([rest[at : at + size] for at in range(0, len(rest), size)], told)

    def _run_batches(self, batches: list[list[int]], told: Callable[[Done], bool]) -> bool:
        """Runs batches; returns whether further runs are wanted."""
        ray = self._ray
        under_way = {self._start(batch): batch for batch in batches if batch}
        while under_way:
            [ready], _ = ray.wait(list(under_way), num_returns=1)
            batch = under_way.pop(ready)
            for done in self._ended(ready, batch, under_way):
                if not told(done):
                    for each in under_way:
                        ray.cancel(each, force=True)
                    return False
        return True

    def _start(self, seeds: list[int]) -> Any:
        return self._remote.remote(self._stored, seeds, self._limits)

    def _ended(self, ready: Any, seeds: list[int], under_way: dict[Any, list[int]]) -> list[Done]:
        """Returns what a batch has come to; seeds of a lost supervisor run again, three times in all."""
        try:
            batch: Batch = self._ray.get(ready)
        except self._ray.exceptions.RayTaskError as error:
            text = str(error.cause if hasattr(error, "cause") else error).strip().splitlines()[-1]
            raise ClusterError(f"a node of the cluster cannot run batches: {text}") from error
        except self._ray.exceptions.RayError as error:
            why = f"its node was lost {MOST_TRIES} times ({type(error).__name__})"
            return [_lost(seed, why) for seed in seeds]
        if batch.fingerprint and batch.fingerprint.get("id") != self._mine["id"]:
            found = "; ".join(differences(batch.fingerprint, self._mine))
            raise ClusterError(f"node {batch.node} is another platform, so that its outcomes differ: {found}")
        done = list(batch.done)
        known = {each.outcome.seed for each in done}
        left = [seed for seed in seeds if seed not in known]
        if left:
            blamed = left[0]
            self._tries[blamed] = self._tries.get(blamed, 0) + 1
            if self._tries[blamed] >= MOST_TRIES:
                done.append(_lost(blamed, f"{batch.lost or 'its supervisor was lost'}, {MOST_TRIES} times"))
                left = left[1:]
            if left:
                under_way[self._start(left)] = left
        return done


def processors_of(address: str) -> int:
    """Returns how many runs a cluster takes at a time.

    Raises:
        ClusterError: there is no such cluster, or Ray is not installed.
    """
    ray = import_ray(is_own=False)
    connect(ray, address)
    try:
        return _processors(ray)
    finally:
        ray.shutdown()


def _processors(ray: Any) -> int:
    return max(1, int(ray.cluster_resources().get("CPU", 1)))


def has_cluster() -> bool:
    """Returns whether this machine belongs to a running cluster, as far as Ray has noted it."""
    return "RAY_ADDRESS" in os.environ or NOTED.exists()


def connect(ray: Any, address: str | None) -> None:
    """Joins a cluster; with None, starts one of this machine alone.

    Raises:
        ClusterError: there is no such cluster.
    """
    options: dict[str, Any] = {"log_to_driver": False, "logging_level": "ERROR"}
    if address is None:
        options |= {"include_dashboard": False, "object_store_memory": STORE_BYTES}
        options |= {"_node_ip_address": "127.0.0.1"}
    if problem := _unreachable(address):
        raise ClusterError(f"--cluster {address}: {problem}")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            patiently(lambda: ray.init(address=address or "local", **options), ray.shutdown)
        except (ConnectionError, ValueError, RuntimeError) as error:
            text = str(error).strip().partition("\n")[0]
            stale = STALE if address == AUTO and NOTED.exists() else ""
            raise ClusterError(
                f"--cluster {address or AUTO}: there is no Ray cluster: {text}{stale}"
            ) from error


def patiently(start: Callable[[], T], clean: Callable[[], object] = lambda: None) -> T:
    """Starts a node of Ray, again if a busy machine was too slow for it.

    Args:
        start: starts the node.
        clean: called before it is started again.

    Raises:
        RuntimeError: it was late each time.
    """
    for left in reversed(range(NODE_STARTS)):
        try:
            return start()
        except Exception as error:
            # Ray raises no class of its own here, and no setting changes its 30 s.
            if LATE not in str(error):
                raise
            if not left:
                raise RuntimeError(str(error)) from error
            clean()
    raise AssertionError("unreachable")


def _unreachable(address: str | None) -> str:
    """Returns why nothing answers at HOST:PORT; "" if it does, or if the address is of another kind.

    Ray itself tries for over a minute, and says nothing meanwhile.
    """
    found = _HOST_PORT.fullmatch(address or "")
    if found is None:
        return ""
    try:
        socket.create_connection((found[1], int(found[2])), timeout=REACH_S).close()
    except OSError as error:
        why = error.strerror or str(error)
        return f"nothing answers there ({why}). Is it the address of the head node, with the port of Ray?"
    return ""


def _lost(seed: int, why: str) -> Done:
    return Done(Outcome(seed, LOST, why), 0.0, 0.0, 0)
