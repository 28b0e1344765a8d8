"""Measures the nodes of the running tree on request, and reports and records their times."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final

from executor import child_messages, messages
from executor.application.sampling import Sampler
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.profiling import NodeTime, Profile, Sums

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from tree_gardener import Tree

    Record = Callable[[int, Sequence[NodeTime]], None]
    MakeSampler = Callable[[int, Callable[[], int]], Sampler]

__all__ = ["ApplicationProfile"]

REPORT_S: Final = 0.5


class ApplicationProfile:
    """The profile of a run; the tree is measured only while it is on.

    Args:
        tree: the tree.
        send: is called with each report, at most twice a second.
        record: is called with a number of ticks and the times of the nodes in them.
        sampler: starts to sample the Python code of a leaf.
        clock: real time in s.
    """

    def __init__(
        self,
        tree: Tree,
        send: Callable[[child_messages.Profile], None],
        record: Record,
        *,
        sampler: MakeSampler = Sampler,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._tree = tree
        self._send = send
        self._record = record
        self._make_sampler = sampler
        self._clock = clock
        self._wanted: messages.SetProfile | None = None
        self._profile: Profile | None = None
        self._sampler: Sampler | None = None
        self._sums = Sums()
        self._ticks = 0
        self._from_tick = 0
        self._due_s = 0.0

    def obey(self, wanted: messages.SetProfile) -> messages.Error | None:
        """Switches it on or off between the next two ticks; returns the error if it is refused."""
        if wanted.sample is not None:
            nodes = self._tree.nodes
            node = nodes[wanted.sample - 1] if wanted.sample <= len(nodes) else None
            if node is None or node.path != wanted.path:
                text = f"The running tree has no node '{wanted.path}'."
                return messages.Error("unknown_node", text, "Run again, so that the tree is the drawn one.")
            if not isinstance(node, BehaviourLeaf):
                text = f"'{node.path}' has no Python code of the project."
                return messages.Error("no_python", text, "Choose an action or a condition of the project.")
        self._wanted = wanted
        return None

    def leave_out(self, duration_s: float) -> None:
        """Takes a hold of the debugger, which has just ended, out of the times."""
        if self._profile is not None:
            self._profile.leave_out(duration_s)

    def between_ticks(self) -> None:
        """Switches what was asked for, and reports what is due."""
        if self._tree.is_ticking:
            return
        if self._wanted is not None:
            self._switch(self._wanted)
            self._wanted = None
        elif self._profile is not None and self._clock() >= self._due_s:
            self._due_s = self._clock() + REPORT_S
            if self._tree.tick_number != self._from_tick:
                self._report()

    def follow(self, tree: Tree) -> None:
        """Measures another tree, which has taken over; the times begin again, without a sampled leaf."""
        is_on = self._profile is not None
        self.close()
        self._tree = tree
        if is_on:
            self._switch(messages.SetProfile(on=True))

    def close(self) -> None:
        """Reports the last times, and ends it."""
        if self._profile is not None and not self._tree.is_ticking:
            self._end()

    def _switch(self, wanted: messages.SetProfile) -> None:
        if self._profile is not None:
            self._end()
        if not wanted.on:
            return
        self._sums, self._ticks = Sums(), 0
        self._from_tick = self._tree.tick_number
        if wanted.sample is not None:
            tree = self._tree
            self._sampler = self._make_sampler(wanted.sample, lambda: tree.current[0])
        self._profile = Profile(self._tree)
        self._tree.profile(self._profile)
        self._due_s = self._clock() + REPORT_S
        self._report()

    def _end(self) -> None:
        self._tree.profile(None)
        self._report(on=False)
        self._profile = None
        if self._sampler is not None:
            self._sampler.close()
            self._sampler = None

    def _report(self, *, on: bool = True) -> None:
        assert self._profile is not None  # noqa: S101 - both callers have one
        ticks, self._from_tick = self._tree.tick_number - self._from_tick, self._tree.tick_number
        times = self._profile.take()
        if times:
            self._record(ticks, times)
        self._sums.add(times)
        self._ticks += ticks
        sampler = self._sampler
        nodes = [
            messages.NodeTime(uid, calls, total_s * 1000.0, self_s * 1000.0)
            for uid, calls, total_s, self_s in self._sums.nodes
        ]
        self._send(
            child_messages.Profile(
                on=on,
                ticks=self._ticks,
                tick_ms=nodes[0].total_ms if nodes else 0.0,
                nodes=nodes,
                sample=None if sampler is None else sampler.uid,
                samples=0 if sampler is None else sampler.samples,
                stacks=[] if sampler is None else sampler.stacks(),
            )
        )
