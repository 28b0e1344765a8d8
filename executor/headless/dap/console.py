"""The commands of a debug console: where a held tree is, and what is forced on its nodes."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING, Final, NamedTuple

from tree_gardener import Status
from tree_gardener.debugging import Force, ForceError, Position

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from tree_gardener import Tree
    from tree_gardener.debugging import Debugger
    from tree_gardener.node import Node

__all__ = ["Console"]

RESULTS: Final = {"success": Status.SUCCESS, "failure": Status.FAILURE, "skipped": Status.SKIPPED}
MOST_LISTED: Final = 8


class _WordsError(ValueError):
    """A command cannot be read, or names no node; the text says why."""


class _Command(NamedTuple):
    form: str
    effect: str
    lines: Callable[[str], Iterator[str]]


class Console:
    """Carries out commands on a held tree; each takes effect at once.

    Args:
        tree: the tree.
        debugger: its debugger.
    """

    def __init__(self, tree: Tree, debugger: Debugger) -> None:
        self._tree = tree
        self._debugger = debugger
        self._commands = {
            "where": _Command("", "prints the path that led here, and why the tree is held", self._where),
            "ahead": _Command(
                "",
                "prints the nodes that may still be ticked in this tick; possible ones, not certain ones",
                self._ahead,
            ),
            "tree": _Command(
                "", "prints all nodes with their statuses; an arrow marks where the tree is held", self._all
            ),
            "force": _Command(
                "NODE success|failure|skipped [once] [after]",
                "forces a result in place of the tick, or after it; once, or until it is released",
                self._force,
            ),
            "freeze": _Command(
                "NODE", "keeps a node RUNNING without a tick, until it is released", self._freeze
            ),
            "skip": _Command(
                "NODE", "skips the siblings before a node, once; below sequences and fallbacks", self._skip
            ),
            "alone": _Command(
                "NODE",
                "ticks a node in place of the root from the next tick on; all else is halted",
                self._alone,
            ),
            "release": _Command("NODE|all", "ends what is forced on a node, or on all", self._release),
            "forces": _Command("", "lists what is forced", self._forces),
            "help": _Command("[COMMAND]", "lists the commands", self._help),
        }

    def takes(self, text: str) -> bool:
        """Returns whether the first word of a line is a command."""
        return (text.split(maxsplit=1) or [""])[0] in self._commands

    def answer(self, text: str) -> str:
        """Carries out a line whose first word is a command; returns what it prints, or why it is not done."""
        word, *rest = text.split(maxsplit=1)
        try:
            return "\n".join(self._commands[word].lines(rest[0].strip() if rest else ""))
        except (_WordsError, ForceError) as error:
            return str(error)

    def _where(self, _: str) -> Iterator[str]:
        stop = self._debugger.held
        if stop is None:
            return
        for depth, uid in enumerate(stop.lead):
            node = self._tree.nodes[uid - 1]
            yield f"{'  ' * depth}{_row(node)}"
        yield f"{stop.what}: {stop.why}"

    def _ahead(self, _: str) -> Iterator[str]:
        stop = self._debugger.held
        if stop is None or not stop.ahead:
            yield "nothing more in this tick"
            return
        yield from (f"#{uid} {self._tree.nodes[uid - 1].path}" for uid in stop.ahead)

    def _all(self, _: str) -> Iterator[str]:
        held = self._debugger.held.uid if self._debugger.held is not None else 0
        depths: dict[int, int] = {}
        for node in self._tree.nodes:
            depth = depths[node.uid] = 0 if node.parent is None else depths[node.parent.uid] + 1
            yield f"{'->' if node.uid == held else '  '} {'  ' * depth}{_row(node)}"

    def _force(self, line: str) -> Iterator[str]:
        name, result, *how = (*_split(line), "", "")
        if result.lower() == "running":
            raise _WordsError("write `freeze NODE` to keep a node RUNNING")
        if result.lower() not in RESULTS or set(how) - {"once", "after", ""}:
            raise _WordsError("write: force NODE success|failure|skipped [once] [after]")
        position = Position.AFTER if "after" in how else Position.BEFORE
        node = _named(self._tree.nodes, name)
        self._debugger.force(Force(node.uid, RESULTS[result.lower()], "once" in how, position))
        yield from self._forces("")

    def _freeze(self, line: str) -> Iterator[str]:
        self._debugger.force(Force(self._node(line).uid, Status.RUNNING))
        yield from self._forces("")

    def _skip(self, line: str) -> Iterator[str]:
        self._debugger.skip_to(self._node(line).uid)
        yield from self._forces("")

    def _alone(self, line: str) -> Iterator[str]:
        self._debugger.run_alone(self._node(line).uid)
        yield from self._forces("")

    def _release(self, line: str) -> Iterator[str]:
        if not self._debugger.release(None if line == "all" else self._node(line).uid):
            yield "nothing was forced there"
        yield from self._forces("")

    def _forces(self, _: str) -> Iterator[str]:
        for force in self._debugger.forces:
            node = self._tree.nodes[force.uid - 1]
            what = "is frozen" if force.status is Status.RUNNING else f"is {force.status.name}"
            once = " once" if force.once else ""
            after = " after its tick" if force.position is Position.AFTER else ""
            yield f"#{node.uid} {node.path} {what}{once}{after}"
        if self._debugger.alone:
            yield f"#{self._debugger.alone} {self._tree.nodes[self._debugger.alone - 1].path} runs alone"
        if not self._debugger.forces and not self._debugger.alone:
            yield "nothing is forced"

    def _help(self, wanted: str) -> Iterator[str]:
        if wanted and wanted not in self._commands:
            raise _WordsError(f"'{wanted}' is no command; `help` lists them")
        for name, command in self._commands.items():
            if wanted in ("", name):
                yield f"{name} {command.form}".rstrip() + f": {command.effect}"
        if not wanted:
            yield "A NODE is a name, a path, or #N. Any other line is a key or a script: speed := 0.5"

    def _node(self, line: str) -> Node:
        words = _split(line)
        if len(words) != 1:
            raise _WordsError("name one node; put a name with blanks into quotes")
        return _named(self._tree.nodes, words[0])


def _row(node: Node) -> str:
    return f"#{node.uid} {node.local_path} [{node.type}] {node.status.name}"


def _split(line: str) -> list[str]:
    """Splits a line into words; quotes hold words together."""
    try:
        return shlex.split(line)
    except ValueError as error:
        raise _WordsError(f"{error}: {line}") from None


def _named(nodes: Sequence[Node], name: str) -> Node:
    """Returns the one node with a number, a path, a name or a type."""
    number = name.removeprefix("#")
    if number.isdecimal() and len(number) < 10 and 0 < int(number) <= len(nodes):
        return nodes[int(number) - 1]
    for attribute in ("path", "name", "type"):
        found = [node for node in nodes if getattr(node, attribute) == name]
        if len(found) == 1:
            return found[0]
        if found:
            listed = ", ".join(f"#{node.uid} {node.path}" for node in found[:MOST_LISTED])
            more = f" and {len(found) - MOST_LISTED} more" if len(found) > MOST_LISTED else ""
            raise _WordsError(
                f"{len(found)} nodes are called '{name}': {listed}{more}; name one by its number or path"
            )
    raise _WordsError(f"no node has the path, name or type '{name}'; `tree` lists all nodes")
