"""Replaces the tree of a running program by that of a changed project, for the command `apply`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor import child_messages, messages
from executor.application.changes.program import NoTreeError
from executor.apply_messages import AppliedNode, LatePort
from tree_gardener import LoadError, TickError
from tree_gardener.errors import describe
from tree_gardener.swap import SwapRefusedError
from tree_gardener.swap.plan import Fate

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path

    from executor.application.changes.program import Change, Program
    from tree_gardener import Tree
    from tree_gardener.runner import Runner
    from tree_gardener.swap import Key, Swap, TreeState

__all__ = ["NOT_APPLIED", "Applying"]

NOT_APPLIED: Final = "not_applied"
CONTINUES: Final = "The running tree continues unchanged."


class Applying:
    """One replacement of the tree of a runner.

    Args:
        program: the running project.
        runner: its runner, between two ticks.
        node: the rclpy node for actions that begin.
        send: is called with the messages for the session.

    Attributes:
        has_python_debugger: whether debugpy is connected. It knows the files that run, and not those of a
            changed project.
    """

    def __init__(
        self,
        program: Program,
        runner: Runner,
        node: Any,
        send: Callable[[child_messages.Applied | child_messages.Fault], None],
    ) -> None:
        self._program = program
        self._runner = runner
        self._node = node
        self._send = send
        self.has_python_debugger = False

    def run(self, folder: Path, follow: Callable[[Tree], None], *, dry: bool) -> messages.Error | None:
        """Replaces the tree by that of the project in `folder`; returns the error if it is refused.

        `follow` is called with the new tree, before the event. With `dry` nothing is replaced.
        """
        if self._runner.tree.is_ticking:
            return messages.Error("held", "The tree is held within a tick.", "Continue it first.")
        if self._runner.is_finished:
            return messages.Error("not_running", "The tree has ended.", "Press Run to start the new one.")
        if self.has_python_debugger:
            text = "The Python debugger is connected to the code that runs."
            return messages.Error(NOT_APPLIED, text, "Restart the program to use the new code.")
        try:
            change = self._program.change(folder, self._runner.tree)
        except (Exception, SystemExit) as error:
            return _refused(error)
        applied = _applied(change.swap, dry=dry)
        if dry:
            change.undo()
            self._send(applied)
            return None
        return self._exchange(change, applied, follow)

    def _exchange(
        self, change: Change, applied: child_messages.Applied, follow: Callable[[Tree], None]
    ) -> messages.Error | None:
        error: messages.Error | None = None
        with change.swap.new.linked_once():
            try:
                change.swap.run(node=self._node)
            except (SwapRefusedError, TickError) as failed:
                error = _refused(failed)
                if not change.swap.is_done:
                    change.undo()
                    return error
            follow(change.swap.new)
        self._send(applied)
        if error is not None:
            text = f"The changed tree runs, but the old one did not end well: {error.message}"
            self._send(child_messages.Fault("exception", text))
        return None


def _applied(swap: Swap, *, dry: bool) -> child_messages.Applied:
    old, new, plan = swap.old_state, swap.new_state, swap.plan
    return child_messages.Applied(
        dry=dry,
        kept=len(plan.with_fate(Fate.KEPT)),
        renewed=_named(plan.with_fate(Fate.RENEWED), new),
        added=_named(plan.added, new),
        removed=_named(plan.with_fate(Fate.REMOVED), old),
        halted=_named(plan.halted, old),
        late_ports=[LatePort(port=late.port, **_fields(late.key, new)) for late in plan.late_ports],
    )


def _named(keys: Iterable[Key], state: TreeState) -> list[AppliedNode]:
    return [AppliedNode(**_fields(key, state)) for key in keys]


def _fields(key: Key, state: TreeState) -> dict[str, str]:
    node = state.nodes[key]
    return {"path": node.path, "node_id": node.attributes.get("_bts_id", ""), "tree_id": node.tree_id}


def _refused(error: BaseException) -> messages.Error:
    """Returns the error for a changed project that cannot take over."""
    if isinstance(error, LoadError):
        first = error.diagnostics[0]
        place = f"{first.file}:{first.line}: " if first.file and first.line else ""
        return messages.Error(NOT_APPLIED, f"{place}{first.message}.", first.hint or CONTINUES)
    if isinstance(error, TickError):
        place = f"{error.file}:{error.line}: " if error.file else ""
        return messages.Error(NOT_APPLIED, f"{place}'{error.path}': {error.message}.", CONTINUES)
    text = str(error) if isinstance(error, (SwapRefusedError, NoTreeError)) else describe(error)
    return messages.Error(NOT_APPLIED, f"{text[:1].upper()}{text[1:]}.", CONTINUES)
