"""The debugger of the application: holds the tree within a tick, and forces results, for the session."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final, Protocol

import msgspec

from executor import child_messages, messages
from tree_gardener import Status
from tree_gardener.debugging import (
    Breakpoint,
    BreakpointError,
    Debugger,
    Force,
    ForceError,
    Place,
    Position,
    Step,
    When,
)
from tree_gardener.errors import ScriptError

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.debug_messages import HeldCause
    from tree_gardener import Tree
    from tree_gardener.debugging import Stop
    from tree_gardener.node import Node
    from tree_gardener.runner import Runner

__all__ = ["ApplicationDebugger", "Host", "Wanted"]

STEPS: Final = {
    "continue": Step.CONTINUE,
    "into": Step.INTO,
    "over": Step.OVER,
    "out": Step.OUT,
    "to": Step.TO,
}
RUN_AGAIN: Final = "Start the program again to use the new tree."
Wanted = (
    child_messages.SetBreakpoints
    | child_messages.Continue
    | child_messages.ForceResult
    | child_messages.ReleaseForced
)
"""The messages that this debugger obeys."""
Said = child_messages.Held | child_messages.Released | child_messages.Forced | child_messages.Log


class Host(Protocol):
    """The process of the debugger, as it uses it."""

    def serve_held(self) -> None:
        """Waits a moment for a message of the session, and obeys it."""

    def show_held(self) -> None:
        """Reports what the tick in progress has written so far."""

    def note_input(self, command: str, data: Any, tick: int, hook: int) -> None:
        """Records what a person did, at the `hook`-th stop of a tick, or at a boundary (-1)."""


class _RefusedError(Exception):
    """A command is refused."""

    def __init__(self, code: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.error = messages.Error(code, message, hint)


class ApplicationDebugger:
    """Obeys the debugger's commands of the session; the tree asks it only while something is set.

    Args:
        runner: the runner of the tree.
        send: is called with each message for the session.
        host: the process.
        clock: measures how long the tree is held, in s.
    """

    def __init__(
        self,
        runner: Runner,
        send: Callable[[Said], None],
        host: Host,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._runner = runner
        self._tree = runner.tree
        self._send = send
        self._host = host
        self._clock = clock
        self._debugger = Debugger(self._hold, self._log)
        self._is_attached = False
        self._is_going = False
        self._is_told = False
        self._wanted: messages.SetBreakpoints | None = None
        self._forced = messages.Forced([])
        self._tick = 0
        self._hook = -1
        self._held_s = 0.0
        self.leave_out: Callable[[float], None] = lambda _: None
        """Is called with the duration of each hold."""

    @property
    def is_holding(self) -> bool:
        """Whether the tree is held at a node now."""
        return self._is_attached and self._debugger.held is not None

    @property
    def place(self) -> tuple[int, int]:
        """The tick, and the number of the stop in it: -1 between two ticks."""
        return self._tree.tick_number, self._hook if self.is_holding else -1

    def take_held_s(self) -> float:
        """Returns for how long the tree was held since the last call, in s."""
        held_s, self._held_s = self._held_s, 0.0
        return held_s

    def obey(self, message: Wanted) -> messages.Error | None:
        """Carries out a command; returns the error if it is refused."""
        try:
            match message:
                case child_messages.SetBreakpoints(wanted=wanted):
                    self._set(wanted)
                case child_messages.Continue():
                    self._continue(message)
                case child_messages.ForceResult(force=force):
                    self._force(force)
                case child_messages.ReleaseForced(uid=uid):
                    self._release(uid)
        except _RefusedError as refused:
            return refused.error
        self._tell_forced()
        return None

    def start(self, wanted: messages.SetBreakpoints | None) -> None:
        """Sets breakpoints for which no client waits; those that the tree refuses are named and left out."""
        if wanted is None or self.obey(child_messages.SetBreakpoints(wanted=wanted)) is None:
            return
        good = []
        for each in wanted.breakpoints:
            refused = self.obey(child_messages.SetBreakpoints(wanted=messages.SetBreakpoints([each])))
            if refused is None:
                good.append(each)
            else:
                self._send(child_messages.Log("warning", refused.message, each.node_id))
        self._set(messages.SetBreakpoints(good, wanted.on))

    def follow(self, tree: Tree) -> None:
        """Debugs another tree, which has taken over: breakpoints follow their blocks, forced results end."""
        self.detach()
        self._tree = tree
        self._debugger = Debugger(self._hold, self._log)
        self.start(self._wanted)
        self._tell_forced()

    def between_ticks(self) -> None:
        """Is called after a tick: a step that did not end in it lets time pass on."""
        if self._tree.is_ticking:
            return
        self._tell_forced()
        if self._is_told:
            self._tell_released()
        elif self._is_attached and not self._is_needed:
            self.detach()

    def detach(self) -> None:
        """Ends all asking."""
        if self._is_attached:
            self._is_attached = False
            self._tree.debug(None)

    def _attach(self) -> Debugger:
        if not self._is_attached:
            self._is_attached = True
            self._tree.debug(self._debugger)
        return self._debugger

    @property
    def _is_needed(self) -> bool:
        debugger = self._debugger
        return bool(debugger.breakpoints.all or debugger.forces or debugger.alone)

    def _set(self, wanted: messages.SetBreakpoints) -> None:
        if not (wanted.breakpoints or self._is_attached):
            return
        debugger = self._attach()
        try:
            debugger.set_breakpoints([_breakpoint(each) for each in wanted.breakpoints])
        except (BreakpointError, ScriptError) as error:
            raise _RefusedError("bad_breakpoint", f"A breakpoint cannot be set: {error}.") from None
        debugger.turn_breakpoints(on=wanted.on)
        self._wanted = wanted

    def _continue(self, message: child_messages.Continue) -> None:
        if message.off and self._is_attached:
            self._debugger.turn_breakpoints(on=False)
        if not (self._is_attached and self._is_told):
            raise _RefusedError("not_held", "The tree is not held at a node now.")
        uid = self._node(message.uid, message.path).uid if message.step == "to" else 0
        if message.pauses:
            self._runner.pause()
        else:
            self._runner.resume()
        step = STEPS[message.step]
        self._debugger.resume(step, uid)
        self._is_going = True
        if step is Step.CONTINUE:
            self._tell_released(paused=message.pauses)

    def _force(self, force: messages.Force) -> None:
        node = self._node(force.uid, force.path)
        debugger = self._attach()
        try:
            if force.effect == "alone":
                debugger.run_alone(node.uid)
            elif force.effect == "skip_to":
                debugger.skip_to(node.uid)
            else:
                position = Position.AFTER if force.after else Position.BEFORE
                debugger.force(Force(node.uid, Status[force.status], force.once, position))
        except ForceError as error:
            raise _RefusedError("not_forced", f"'{node.path}': {error}.") from None
        self._host.note_input("force", msgspec.to_builtins(force), *self.place)

    def _release(self, uid: int | None) -> None:
        if self._is_attached and self._debugger.release(uid):
            self._host.note_input("release", {"uid": uid}, *self.place)

    def _node(self, uid: int, path: str) -> Node:
        nodes = self._tree.nodes
        if uid > len(nodes) or nodes[uid - 1].path != path:
            raise _RefusedError("unknown_node", f"The running tree has no node '{path}'.", RUN_AGAIN)
        return nodes[uid - 1]

    def _hold(self, stop: Stop) -> None:
        """Holds the tree until a command lets it continue."""
        self._hook = self._hook + 1 if stop.tick == self._tick else 0
        self._tick = stop.tick
        self._is_going, self._is_told = False, True
        since_s = self._clock()
        self._host.show_held()
        self._tell_forced()
        self._send(self._held(stop))
        self._note_hold(stop)
        try:
            while not self._is_going:
                self._host.serve_held()
        finally:
            duration_s = self._clock() - since_s
            self._held_s += duration_s
            self.leave_out(duration_s)

    def _note_hold(self, stop: Stop) -> None:
        """Records where the tree is held: `Input` with the command `hold`, and its place in the tick."""
        hold = {"uid": stop.uid, "path": stop.path, "event": stop.event.value, "why": stop.why}
        self._host.note_input("hold", hold, stop.tick, self._hook)

    def _held(self, stop: Stop) -> child_messages.Held:
        statuses = [
            (node.uid, node.status.name) for node in self._tree.nodes if node.status is not Status.IDLE
        ]
        return msgspec.convert(
            {
                "type": "held",
                "uid": stop.uid,
                "path": list(stop.lead),
                "why": stop.why,
                "ahead": list(stop.ahead),
                "cause": _cause(stop.why),
                "event": stop.event.value,
                "tick": stop.tick,
                "status": stop.status.name if stop.status is not None else None,
                "decided": stop.decided,
                "statuses": statuses,
                "hook": self._hook,
            },
            child_messages.Held,
        )

    def _tell_released(self, *, paused: bool = False) -> None:
        self._is_told = False
        self._send(child_messages.Released(paused))

    def _tell_forced(self) -> None:
        debugger, forced = self._debugger, messages.Forced([])
        if self._is_attached and (debugger.alone or debugger.forces):
            forced = messages.Forced([_forced(each) for each in debugger.forces], debugger.alone)
        if forced != self._forced:
            self._forced = forced
            self._send(child_messages.Forced(forced.nodes, forced.alone))

    def _log(self, text: str) -> None:
        self._send(child_messages.Log("info", text))


def _breakpoint(each: messages.Breakpoint) -> Breakpoint:
    instance = None if each.instance is None else tuple(each.instance)
    return Breakpoint(
        Place(each.tree_id, each.node_id, instance),
        When(each.when),
        Status[each.status] if each.status is not None else None,
        each.condition,
        each.hits,
        each.log,
        each.on,
    )


def _forced(force: Force) -> messages.ForcedNode:
    fields = {
        "uid": force.uid,
        "status": force.status.name,
        "once": force.once,
        "after": force.position is Position.AFTER,
        "skips_to": force.skips_to,
    }
    return msgspec.convert(fields, messages.ForcedNode)


def _cause(why: str) -> HeldCause:
    if why.startswith("breakpoint "):
        return "breakpoint"
    return "condition" if why.startswith("the condition ") else "step"
