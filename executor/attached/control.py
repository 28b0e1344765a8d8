"""Breakpoints and forced results at another program's tree, as hooks of Groot2's protocol."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Literal, Protocol

from executor import child_messages, messages
from tree_gardener.groot.protocol import GrootError, Hook, HookKey, Mode, Position, Unlock
from tree_gardener.status import Status

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from executor.attached.following import Statuses
    from executor.messages import Breakpoint, TreeNode

__all__ = ["Control", "HookClient", "RefusedError", "explain"]

_POSITIONS: Final = {"before": Position.BEFORE, "after": Position.AFTER}
_ONLY: Final = "Groot2's protocol has breakpoints before and after the tick of a node, without conditions."
_RESULTS: Final = frozenset({"SUCCESS", "FAILURE"})
Said = child_messages.Held | child_messages.Released | child_messages.Forced
Wanted = (
    child_messages.SetBreakpoints
    | child_messages.Continue
    | child_messages.ForceResult
    | child_messages.ReleaseForced
    | child_messages.Control
)
"""The commands that are obeyed here."""


class HookClient(Protocol):
    """The part of `Groot2Client` that sets hooks."""

    def insert(self, hooks: Iterable[Hook]) -> None:
        """Inserts hooks."""

    def remove(self, key: HookKey) -> None:
        """Removes a hook."""

    def hooks(self) -> list[Hook]:
        """Returns all hooks."""

    def unlock(self, answer: Unlock) -> None:
        """Continues a tree that waits."""


class RefusedError(Exception):
    """A command is refused."""

    def __init__(self, code: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.error = messages.Error(code, message, hint)


class Control:
    """The breakpoints and forced results of the user, as hooks of the other program.

    Args:
        nodes: the nodes of the tree.
        numbers: our uid of each node, by its uid in the other program.
        client: asks the other program.
        send: is called with each message for the session.
        statuses: the statuses as they were last seen.
    """

    def __init__(
        self,
        nodes: Sequence[TreeNode],
        numbers: Mapping[int, int],
        client: HookClient,
        send: Callable[[Said], None],
        statuses: Statuses,
    ) -> None:
        self._nodes = {node.uid: node for node in nodes}
        self._numbers = numbers
        self._theirs = {own: remote for remote, own in numbers.items()}
        self._client = client
        self._send = send
        self._statuses = statuses
        self._wanted = messages.SetBreakpoints([])
        self._forces: dict[int, messages.Force] = {}
        self._held: HookKey | None = None
        self._last: dict[int, HookKey] = {}
        self._result = Status.SKIPPED
        self._stops = 0
        self.is_on = False

    @property
    def is_holding(self) -> bool:
        """Whether the tree waits at one of our breakpoints."""
        return self._held is not None

    def obey(self, message: Wanted) -> None:
        """Carries out a command.

        Raises:
            RefusedError: it is not possible in this protocol, or without control.
            GrootError: the other program does not answer, or refuses it.
        """
        before = self._wanted, self._forces, self._result, self.is_on
        try:
            self._take(message)
            self.restore()
        except GrootError:
            self._wanted, self._forces, self._result, self.is_on = before
            raise
        self._tell_forced()

    def _take(self, message: Wanted) -> None:
        match message:
            case child_messages.SetBreakpoints(wanted=wanted):
                for each in wanted.breakpoints if wanted.on else ():
                    self._keys_of(each)
                self._wanted = wanted
            case child_messages.Continue():
                self._continue(message)
            case child_messages.ForceResult(force=force):
                self._force(force)
            case child_messages.ReleaseForced(uid=uid):
                self._forces = {} if uid is None else {k: v for k, v in self._forces.items() if k != uid}
                self._result = Status.SKIPPED
            case child_messages.Control(on=on):
                self._switch(on=on)

    def restore(self) -> None:
        """Puts in place what the user has set, and removes every other hook.

        Raises:
            GrootError: the other program does not answer, or refuses it.
        """
        if not self.is_on:
            return
        wanted = self._hooks()
        there = {hook.key: hook for hook in self._client.hooks()}
        for key in there.keys() - wanted.keys():
            self._client.remove(key)
            if key == self._held:
                self._release()
        missing = [hook for key, hook in wanted.items() if there.get(key) != hook]
        if missing:
            self._client.insert(missing)

    def withdraw(self) -> None:
        """Removes all hooks for now, so that the tree does not wait where nobody hears of it.

        Raises:
            GrootError: the other program does not answer.
        """
        self._release()
        for hook in self._client.hooks() if self.is_on else ():
            self._client.remove(hook.key)

    def refresh(self) -> None:
        """Notes which results, forced once, are done, and puts back what a restarted program has lost.

        Raises:
            GrootError: the other program does not answer.
        """
        there = {hook.key for hook in self._client.hooks()}
        done = [uid for uid, force in self._forces.items() if force.once and self._key(force) not in there]
        self._forces = {uid: force for uid, force in self._forces.items() if uid not in done}
        if done:
            self._tell_forced()
        self.restore()

    def reached(self, uid: int) -> None:
        """Takes the message that a hook was reached, of a node by its uid in the other program."""
        node = self._nodes.get(self._numbers.get(uid, 0))
        hooks = self._hooks()
        keys = [key for key, hook in hooks.items() if key.uid == uid and hook.mode is Mode.BREAKPOINT]
        if node is None or not keys or not self.is_on:
            return
        # The message does not say which of the two hooks of a node was reached; they alternate.
        key = next((each for each in sorted(keys) if each != self._last.get(uid)), keys[0])
        self._held = self._last[uid] = key
        path = [node.uid]
        while (parent := self._nodes[path[0]].parent) in self._nodes:
            path.insert(0, parent)
        event: Literal["before", "after"] = "before" if key.position is Position.BEFORE else "after"
        held = child_messages.Held(
            uid=node.uid,
            path=path,
            why=f"The breakpoint {event} the tick of '{node.name}' was reached.",
            ahead=[],
            cause="breakpoint",
            event=event,
            tick=self._statuses.looks,
            statuses=self._statuses.awake(),
            hook=self._stops,
        )
        self._stops += 1
        self._send(held)

    def lost(self) -> None:
        """Notes that the other program is gone, or does not answer: nobody knows whether it is held."""
        self._release()

    def end(self) -> None:
        """Removes all that was set, as at the end of the session.

        Raises:
            GrootError: the other program does not answer.
        """
        if self.is_on:
            self._switch(on=False)

    def _switch(self, *, on: bool) -> None:
        if self.is_on and not on:
            ours = self._hooks().keys()
            for hook in self._client.hooks():
                if hook.key in ours:
                    self._client.remove(hook.key)
            self._forces = {}
            self._release()
        self.is_on = on

    def _continue(self, message: child_messages.Continue) -> None:
        if message.step != "continue":
            raise RefusedError("no_steps", "Groot2's protocol has no steps: the tree can only continue.")
        held = self._held
        if held is None:
            return
        self._client.unlock(Unlock(held, self._result, remove_when_done=False))
        self._forces = {k: v for k, v in self._forces.items() if not (self._key(v) == held and v.once)}
        if message.off:
            self._wanted = messages.SetBreakpoints(self._wanted.breakpoints, on=False)
        self._release()

    def _release(self) -> None:
        self._result = Status.SKIPPED
        if self._held is not None:
            self._held = None
            self._send(child_messages.Released())

    def _force(self, force: messages.Force) -> None:
        node = self._nodes.get(force.uid)
        if node is None or node.path != force.path:
            raise RefusedError("unknown_node", "This node is not in the tree any more.")
        if not self.is_on:
            raise RefusedError(
                "no_control",
                "Nothing is forced while you only look.",
                "Switch on 'I control this robot' first.",
            )
        if force.effect != "result" or force.status not in _RESULTS:
            text = "Groot2's protocol can force SUCCESS or FAILURE alone."
            raise RefusedError("not_forced", text, "It can neither freeze or skip a node nor run one alone.")
        self._forces = {**self._forces, force.uid: force}
        if self._held == self._key(force):
            self._result = Status[force.status]

    def _hooks(self) -> dict[HookKey, Hook]:
        """Returns the hooks that are wanted; a forced result goes before a breakpoint at its place."""
        hooks: dict[HookKey, Hook] = {}
        for each in self._wanted.breakpoints if self._wanted.on else ():
            for key in self._keys_of(each) if each.on else ():
                hooks[key] = Hook(
                    key, Mode.BREAKPOINT, once=False, desired_status=Status.SKIPPED, enabled=True
                )
        for force in self._forces.values():
            key = self._key(force)
            if key != self._held:  # the tree waits there, and gets the result when it continues
                hooks[key] = Hook(key, Mode.REPLACE, force.once, Status[force.status], enabled=True)
        return hooks

    def _keys_of(self, wanted: Breakpoint) -> list[HookKey]:
        """Returns the places of a breakpoint; none for a block that is not in the tree.

        Raises:
            RefusedError: the protocol has no such breakpoint.
        """
        position = _POSITIONS.get(wanted.when)
        if position is None or wanted.condition or wanted.log or wanted.hits > 1:
            raise RefusedError("bad_breakpoint", _ONLY)
        found = [
            node
            for node in self._nodes.values()
            if (node.tree_id, node.node_id) == (wanted.tree_id, wanted.node_id)
            and (wanted.instance is None or self._instance(node) == wanted.instance)
        ]
        return [HookKey(self._theirs[node.uid], position) for node in found]

    def _instance(self, node: TreeNode) -> list[str]:
        """Returns the ids of the SubTree nodes that lead to a node."""
        ids: list[str] = []
        above = self._nodes.get(node.parent)
        while above is not None:
            if above.kind == "SubTree":
                ids.insert(0, above.node_id)
            above = self._nodes.get(above.parent)
        return ids

    def _key(self, force: messages.Force) -> HookKey:
        return HookKey(self._theirs[force.uid], Position.AFTER if force.after else Position.BEFORE)

    def _tell_forced(self) -> None:
        forced = [
            messages.ForcedNode(force.uid, force.status, force.once, force.after)
            for force in self._forces.values()
        ]
        self._send(child_messages.Forced(forced))


def explain(error: GrootError) -> messages.Error:
    """Returns the answer to a command that the other program did not take."""
    return messages.Error("other_program", f"The other program did not take it: {error}.")
