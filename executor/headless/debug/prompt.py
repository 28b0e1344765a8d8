"""The prompt of the debugger: reads commands while the tree is held, and prints what they ask for."""

from __future__ import annotations

import cmd
from typing import TYPE_CHECKING, Any, Final, TextIO

from executor.headless.debug.help import HELP
from executor.headless.debug.names import UnknownNodeError, names_of, node_named, place_named
from executor.headless.debug.words import MOMENTS, RESULTS, WordsError, breakpoint_of, split, whole
from tree_gardener import PortError, ScriptError, Status
from tree_gardener.blackboard import EMPTY
from tree_gardener.debugging import (
    BreakpointError,
    Debugger,
    DebuggingEnded,
    Force,
    ForceError,
    Position,
    Step,
    nodes_at,
)
from tree_gardener.script import Environment, compile_script

if TYPE_CHECKING:
    from collections.abc import Callable

    from tree_gardener import Tree
    from tree_gardener.debugging import Breakpoint, Stop
    from tree_gardener.node import Node

REFUSED: Final = (UnknownNodeError, WordsError, BreakpointError, ForceError, ScriptError, PortError)
SHORT: Final = {
    "b": "break",
    "c": "continue",
    "s": "into",
    "step": "into",
    "n": "over",
    "next": "over",
    "p": "print",
    "w": "where",
    "q": "quit",
    "exit": "quit",
    "h": "help",
    "?": "help",
    "f": "force",
}
LONGEST: Final = 200


class Prompt(cmd.Cmd):
    """Reads and carries out commands; each takes effect at once, and the steps end the prompt.

    Args:
        tree: the tree.
        debugger: its debugger.
        now_s: returns the simulated time in s.
        stdin: the commands, if they do not come from the terminal.
        stdout: for the answers.

    Attributes:
        is_reading: whether it waits for a command; only then may Ctrl+C interrupt it.
    """

    intro = None
    prompt = "(bt) "

    def __init__(
        self,
        tree: Tree,
        debugger: Debugger,
        now_s: Callable[[], float],
        stdin: TextIO | None = None,
        stdout: TextIO | None = None,
    ) -> None:
        super().__init__(stdin=stdin, stdout=stdout)
        self.use_rawinput = stdin is None
        if stdin is not None:
            self.prompt = ""
        self.tree = tree
        self.debugger = debugger
        self.now_s = now_s
        self.is_reading = False

    # -- the loop -----------------------------------------------------------------------------------

    def serve(self, stop: Stop) -> None:
        """Reads commands at a stop until one lets the tree continue.

        Raises:
            DebuggingEnded: the user ends the run.
        """
        node = self.tree.nodes[stop.uid - 1]
        moment = f"{self.now_s():.2f} s, tick {stop.tick}"
        self.say(f"{moment}: #{node.uid} {node.path} [{node.type}] {stop.what}  ({stop.why})")
        while True:
            try:
                self.cmdloop()
                return
            except KeyboardInterrupt:
                self.is_reading = False
                self.say("\nthe tree is held: `continue` lets it run, `quit` ends the run")

    def preloop(self) -> None:
        """Notes that the next command is awaited."""
        self.is_reading = True

    def precmd(self, line: str) -> str:
        """Notes that a command is being carried out."""
        self.is_reading = False
        return line

    def postcmd(self, stop: bool, line: str) -> bool:  # noqa: FBT001 - cmd's way
        """Notes that the next command is awaited."""
        self.is_reading = not stop
        return stop

    def onecmd(self, line: str) -> bool:
        """Carries out one command; returns whether the tree continues."""
        word, _, rest = line.strip().partition(" ")
        full = SHORT.get(word, word)
        try:
            return bool(super().onecmd(f"{full} {rest}" if full != "EOF" else full))
        except REFUSED as error:
            self.say(str(error))
            return False

    def emptyline(self) -> bool:
        """Does nothing; cmd would repeat the last command."""
        return False

    def default(self, line: str) -> None:
        """Answers an unknown command."""
        self.say(f"'{line.split(maxsplit=1)[0]}' is no command; `help` lists them")

    def say(self, text: str) -> None:
        """Prints a line."""
        self.stdout.write(f"{text}\n")
        self.stdout.flush()

    # -- breakpoints --------------------------------------------------------------------------------

    def do_break(self, line: str) -> None:
        """Sets a breakpoint, or lists all."""
        nodes = self.tree.nodes
        if not line.strip():
            return self._list_breakpoints()
        new = breakpoint_of(line, lambda name: place_named(nodes, name))
        before = [each for each in self.debugger.breakpoints.all if each != new]
        self.debugger.set_breakpoints([*before, new])
        return self._list_breakpoints()

    def do_delete(self, line: str) -> None:
        """Removes a breakpoint, or all."""
        self.debugger.set_breakpoints([] if line.strip() == "all" else self._without(line))
        self._list_breakpoints()

    def _without(self, line: str) -> list[Breakpoint]:
        found = list(self.debugger.breakpoints.all)
        number = whole(line.strip())
        if number is None or not 0 < number <= len(found):
            raise WordsError(f"there is no breakpoint '{line.strip()}'; `break` lists them")
        del found[number - 1]
        return found

    def do_off(self, line: str) -> None:
        """Switches all breakpoints off."""
        self.debugger.turn_breakpoints(on=False)
        self._list_breakpoints()

    def do_on(self, line: str) -> None:
        """Switches all breakpoints on."""
        self.debugger.turn_breakpoints(on=True)
        self._list_breakpoints()

    def _list_breakpoints(self) -> None:
        breakpoints = self.debugger.breakpoints
        if not breakpoints.all:
            self.say("no breakpoints")
        for number, each in enumerate(breakpoints.all, 1):
            parts = [f"if {each.condition}"] if each.condition else []
            parts += [f"from hit {each.hits} on"] if each.hits > 1 else []
            parts += [f"log '{each.log}'"] if each.log else []
            where = (
                ""
                if each.place.instance is None
                else f" in {'/'.join(each.place.instance) or 'the main tree'}"
            )
            more = " ".join(["", *parts, f"({breakpoints.hits(each)} hits)"])
            state = "" if breakpoints.are_on else " off"
            block = f"{self._name(each)} in tree {each.place.tree_id}{where}"
            self.say(f"{number}{state}: {block}, {each.moment}{more}")

    def _name(self, each: Breakpoint) -> str:
        found = nodes_at(self.tree.nodes, each.place)
        return found[0].name if found else each.place.key

    # -- steps --------------------------------------------------------------------------------------

    def do_continue(self, line: str) -> bool:
        """Continues to the next breakpoint."""
        return self._resume(Step.CONTINUE)

    def do_into(self, line: str) -> bool:
        """Continues to the next event."""
        return self._resume(Step.INTO)

    def do_over(self, line: str) -> bool:
        """Continues until this node is done."""
        return self._resume(Step.OVER)

    def do_out(self, line: str) -> bool:
        """Continues until the parent is done."""
        return self._resume(Step.OUT)

    def do_tick(self, line: str) -> bool:
        """Continues to the next tick."""
        return self._resume(Step.TICK)

    def do_to(self, line: str) -> bool:
        """Continues to a node."""
        return self._resume(Step.TO, self._node(line).uid)

    def _resume(self, step: Step, target: int = 0) -> bool:
        self.debugger.resume(step, target)
        return True

    def do_quit(self, line: str) -> bool:
        """Ends the run."""
        raise DebuggingEnded

    def do_EOF(self, line: str) -> bool:  # noqa: N802 - cmd's name
        """Ends the run, since the input ended."""
        raise DebuggingEnded

    # -- looking ------------------------------------------------------------------------------------

    def do_where(self, line: str) -> None:
        """Prints the path to the node."""
        stop = self.debugger.held
        if stop is None:
            return
        for depth, uid in enumerate(stop.lead):
            node = self.tree.nodes[uid - 1]
            self.say(f"{'  ' * depth}#{uid} {node.local_path} [{node.type}] {node.status.name}")
        self.say(f"{stop.what}: {stop.why}")

    def do_ahead(self, line: str) -> None:
        """Prints the nodes ahead."""
        stop = self.debugger.held
        paths = [] if stop is None else [f"#{uid} {self.tree.nodes[uid - 1].path}" for uid in stop.ahead]
        self.say("\n".join(paths) or "nothing more in this tick")

    def do_tree(self, line: str) -> None:
        """Prints all nodes."""
        held = self.debugger.held.uid if self.debugger.held is not None else 0
        depths: dict[int, int] = {}
        for node in self.tree.nodes:
            depth = depths[node.uid] = 0 if node.parent is None else depths[node.parent.uid] + 1
            arrow = "->" if node.uid == held else "  "
            self.say(f"{arrow} {'  ' * depth}#{node.uid} {node.local_path} [{node.type}] {node.status.name}")

    def do_print(self, line: str) -> None:
        """Prints blackboard entries."""
        board = self._held_node().board
        key = line.strip()
        if key:
            entry = board.find(key)
            if entry is None:
                raise WordsError(f"there is no entry '{key}' here; `print` lists all entries")
            self.say(f"{key} = {shown_value(entry.value)}")
            return
        for each in self.tree.boards:
            for name, entry in sorted(each.entries.items()):
                self.say(f"{each.path + '/' if each.path else ''}{name} = {shown_value(entry.value)}")

    def do_set(self, line: str) -> None:
        """Runs a script."""
        node = self._held_node()
        value = compile_script(line).run(Environment(node.board, self.tree.enums))
        self.say(shown_value(value))

    # -- forced results -----------------------------------------------------------------------------

    def do_force(self, line: str) -> None:
        """Forces a result."""
        words = split(line)
        if len(words) < 2 or words[1].lower() not in RESULTS or set(words[2:]) - {"once", "after"}:
            raise WordsError("write: force NODE success|failure|skipped [once] [after]")
        position = Position.AFTER if "after" in words[2:] else Position.BEFORE
        status = RESULTS[words[1].lower()]
        if status is Status.RUNNING:
            raise WordsError("write `freeze NODE` to keep a node RUNNING")
        self.debugger.force(Force(self._node(words[0]).uid, status, "once" in words[2:], position))
        self.do_forces("")

    def do_freeze(self, line: str) -> None:
        """Freezes a node."""
        self.debugger.force(Force(self._node(line).uid, Status.RUNNING))
        self.do_forces("")

    def do_skip(self, line: str) -> None:
        """Skips siblings."""
        self.debugger.skip_to(self._node(line).uid)
        self.do_forces("")

    def do_alone(self, line: str) -> None:
        """Makes a node run alone."""
        self.debugger.run_alone(self._node(line).uid)
        self.do_forces("")

    def do_release(self, line: str) -> None:
        """Releases a node, or all."""
        uid = None if line.strip() == "all" else self._node(line).uid
        if not self.debugger.release(uid):
            self.say("nothing was forced there")
        self.do_forces("")

    def do_forces(self, line: str) -> None:
        """Lists forced results."""
        for force in self.debugger.forces:
            node = self.tree.nodes[force.uid - 1]
            what = "is frozen" if force.status is Status.RUNNING else f"is {force.status.name}"
            how = [
                *(["once"] if force.once else []),
                *(["after its tick"] if force.position is Position.AFTER else []),
            ]
            self.say(" ".join([f"#{node.uid} {node.path} {what}", *how]))
        if self.debugger.alone:
            self.say(f"#{self.debugger.alone} {self.tree.nodes[self.debugger.alone - 1].path} runs alone")
        if not self.debugger.forces and not self.debugger.alone:
            self.say("nothing is forced")

    # -- help ---------------------------------------------------------------------------------------

    def do_help(self, arg: str) -> None:
        """Lists the commands."""
        wanted = SHORT.get(arg.strip(), arg.strip())
        if wanted and wanted not in HELP:
            raise WordsError(f"'{arg}' is no command; `help` lists them")
        for name, (form, effect) in HELP.items():
            if wanted in ("", name):
                self.say(f"{name} {form}".rstrip() + f": {effect}")
        if not wanted:
            short = ", ".join(f"{word} = {name}" for word, name in SHORT.items())
            self.say(f"A NODE is a name, a path, or #N. Short forms: {short}")

    # -- words --------------------------------------------------------------------------------------

    def completedefault(self, *ignored: Any) -> list[str]:
        """Completes names of nodes and the words of `break` and `force`."""
        text = str(ignored[0])
        words = [
            *(_quoted(name) for name in names_of(self.tree.nodes)),
            *MOMENTS,
            "if",
            "hits",
            "log",
            "once",
        ]
        return [word for word in words if word.startswith(text)]

    def _node(self, line: str) -> Node:
        words = split(line)
        if len(words) != 1:
            raise WordsError("name one node; put a name with blanks into quotes")
        return node_named(self.tree.nodes, words[0])

    def _held_node(self) -> Node:
        stop = self.debugger.held
        return self.tree.nodes[0 if stop is None else stop.uid - 1]


def _quoted(name: str) -> str:
    return f"'{name}'" if " " in name else name


def shown_value(value: object, longest: int = LONGEST) -> str:
    """Returns a value as text of at most so many characters; a class of the user may fail at it."""
    if value is EMPTY:
        return "(empty)"
    try:
        text = repr(value)
    except Exception as error:  # noqa: BLE001, RUF100 - a class of the user
        return f"<{type(value).__name__}: {error}>"
    return text if len(text) <= longest else f"{text[: longest - 1]}…"
