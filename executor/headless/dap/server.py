"""Answers the requests of a client of the Debug Adapter Protocol about a tree that runs or is held."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from executor.headless.dap.console import Console
from executor.headless.dap.lines import NoBlockError
from executor.headless.dap.values import Values, ValuesError, evaluated
from tree_gardener.debugging import Breakpoint, BreakpointError, DebuggingEnded, Step
from tree_gardener.debugging.breakpoints import check

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.headless.dap.lines import Lines
    from executor.headless.dap.paths import Folder
    from executor.headless.dap.wire import Request, Wire
    from tree_gardener import Tree
    from tree_gardener.debugging import Debugger, Stop
    from tree_gardener.node import Node

__all__ = ["CAPABILITIES", "Server"]

CAPABILITIES: Final = {
    "supportsConditionalBreakpoints": True,
    "supportsConfigurationDoneRequest": True,
    "supportsEvaluateForHovers": True,
    "supportsHitConditionalBreakpoints": True,
    "supportsLogPoints": True,
    "supportsSetVariable": True,
    "supportsTerminateRequest": True,
}
THREAD: Final = 1
STEPS: Final = {"continue": Step.CONTINUE, "next": Step.OVER, "stepIn": Step.INTO, "stepOut": Step.OUT}
_HITS: Final = re.compile(r"\s*(?:>=)?\s*([0-9]{1,9})\s*")
MOST_BREAKPOINTS: Final = 1000


class _NotNowError(ValueError):
    """A request is not possible now; the text says why."""


class Server:
    """The debugger of one run for one client. All is called on the ticking thread.

    Args:
        wire: leads to the client.
        tree: the tree.
        debugger: its debugger.
        lines: the lines of its blocks.
        folder: the folder of the files, which have paths below it.
        now_s: returns the simulated time in s.
    """

    def __init__(  # noqa: PLR0913, PLR0917 - a run, and who debugs it
        self,
        wire: Wire,
        tree: Tree,
        debugger: Debugger,
        lines: Lines,
        folder: Folder,
        now_s: Callable[[], float],
    ) -> None:
        self._wire, self._tree, self._debugger, self._lines = wire, tree, debugger, lines
        self._folder = folder
        self._now_s = now_s
        self._values = Values()
        self._console = Console(tree, debugger)
        self._set: dict[str, list[Breakpoint]] = {}
        self._is_configured = False
        self._goes_on = False
        self._pauses = False
        self.first_line = 1

    def configure(self) -> None:
        """Answers until the client has set its breakpoints.

        Raises:
            DebuggingEnded: it is gone.
        """
        while not self._is_configured:
            self.obey(self._wire.requests.get())

    def poll(self) -> None:
        """Answers the requests that wait while the tree runs, between two ticks.

        Raises:
            DebuggingEnded: the client ends the run.
        """
        while not self._wire.requests.empty():
            self.obey(self._wire.requests.get())

    def hold(self, stop: Stop) -> None:
        """Answers while the tree is held, until the client continues it.

        Raises:
            DebuggingEnded: the client ends the run.
        """
        self._goes_on = False
        self._wire.tell("stopped", **self._stopped(stop))
        while not self._goes_on:
            self.obey(self._wire.requests.get())
        self._values.forget()

    def _stopped(self, stop: Stop) -> dict[str, Any]:
        is_paused, self._pauses = self._pauses, False
        reason = "breakpoint" if stop.why.startswith(("breakpoint", "the condition")) else "step"
        text = f"{stop.path} {stop.what} ({stop.why}), {self._now_s():.2f} s, tick {stop.tick}"
        return {
            "reason": "pause" if is_paused and reason == "step" else reason,
            "description": text,
            "text": text,
            "threadId": THREAD,
            "allThreadsStopped": True,
        }

    def obey(self, request: Request) -> None:
        """Answers one request.

        Raises:
            DebuggingEnded: it ends the run.
        """
        if request.command in {"disconnect", "terminate"}:
            self._wire.respond(request)
            raise DebuggingEnded
        handlers: dict[str, Callable[[Request], dict[str, Any] | None]] = {
            "setBreakpoints": self._set_breakpoints,
            "setExceptionBreakpoints": lambda _: {"breakpoints": []},
            "configurationDone": self._configured,
            "threads": lambda _: {"threads": [{"id": THREAD, "name": f"tree {self._tree.nodes[0].tree_id}"}]},
            "stackTrace": self._stack,
            "scopes": lambda each: {"scopes": self._values.scopes(self._node(each.number("frameId")))},
            "variables": lambda each: {
                "variables": self._values.variables(each.number("variablesReference"))
            },
            "setVariable": lambda each: self._values.set(
                each.number("variablesReference"), each.text("name"), each.text("value")
            ),
            "evaluate": self._evaluate,
            "pause": self._pause,
        }
        handler = self._step if request.command in STEPS else handlers.get(request.command)
        if handler is None:
            known = ", ".join(sorted([*handlers, *STEPS, "disconnect", "terminate"]))
            self._wire.refuse(request, f"'{request.command[:100]}' is not known here; known are {known}")
            return
        try:
            body = handler(request)
        except (_NotNowError, ValuesError) as error:
            self._wire.refuse(request, str(error))
            return
        self._wire.respond(request, body)

    def _configured(self, _: Request) -> None:
        self._is_configured = True

    def _pause(self, _: Request) -> None:
        if self._debugger.held is None:
            self._pauses = True
            self._debugger.request_hold()

    def _step(self, request: Request) -> dict[str, Any]:
        self._held()
        self._debugger.resume(STEPS[request.command])
        self._goes_on = True
        return {"allThreadsContinued": True} if request.command == "continue" else {}

    def _set_breakpoints(self, request: Request) -> dict[str, Any]:
        source = request.arguments.get("source")
        path = source.get("path") if isinstance(source, dict) else None
        wanted = request.arguments.get("breakpoints")
        rows = [each for each in wanted if isinstance(each, dict)] if isinstance(wanted, list) else []
        if not isinstance(path, str) or len(rows) > MOST_BREAKPOINTS:
            raise _NotNowError(f"breakpoints need the path of a file, and are {MOST_BREAKPOINTS} at most")
        name = self._folder.below(path)
        answers, found = [], []
        for row in rows:
            try:
                each, line = self._breakpoint(name, row)
            except (NoBlockError, BreakpointError) as error:
                why = f"{error}{self._folder.hint(path)}"
                answers.append({"verified": False, "message": why, "line": row.get("line")})
            else:
                found.append(each)
                answers.append({"verified": True, "line": line - 1 + self.first_line})
        self._set[name] = found
        self._debugger.set_breakpoints([each for those in self._set.values() for each in those])
        return {"breakpoints": answers}

    def _breakpoint(self, name: str, row: dict[str, Any]) -> tuple[Breakpoint, int]:
        line = row.get("line")
        if type(line) is not int:
            raise BreakpointError("a breakpoint needs a line")
        block = self._lines.block(name, line + 1 - self.first_line)
        hits = str(row.get("hitCondition") or "1")
        if (number := _HITS.fullmatch(hits)) is None:
            raise BreakpointError(f"'{hits[:20]}' is no first hit that counts, such as 3 or >= 3")
        condition, log = str(row.get("condition") or ""), str(row.get("logMessage") or "")
        made = Breakpoint(block.place, condition=condition, hits=int(number[1]), log=log)
        check(made)
        return made, block.first

    def _stack(self, request: Request) -> dict[str, Any]:
        lead = self._held().lead[::-1]
        begin, count = max(0, request.number("startFrame")), request.number("levels") or len(lead)
        frames = [self._frame(self._tree.nodes[uid - 1]) for uid in lead[begin : begin + count]]
        return {"stackFrames": frames, "totalFrames": len(lead)}

    def _frame(self, node: Node) -> dict[str, Any]:
        stop = self._held()
        what = f", {stop.what}" if node.uid == stop.uid else ""
        kind = "" if node.name == node.type else f" [{node.type}]"
        frame: dict[str, Any] = {"id": node.uid, "name": f"{node.name}{kind} {node.status.name}{what}"}
        if (found := self._lines.line(node)) is None:
            return frame | {"line": 0, "column": 0, "presentationHint": "subtle"}
        name, path = self._folder.named(found[0])
        source = {"name": name, "path": path}
        return frame | {"line": found[1] - 1 + self.first_line, "column": self.first_line, "source": source}

    def _evaluate(self, request: Request) -> dict[str, Any]:
        text, stop = request.text("expression"), self._held()
        node = self._node(request.number("frameId", stop.uid))
        is_console = request.text("context", "repl") == "repl"
        if is_console and self._console.takes(text):
            return {"result": self._console.answer(text), "variablesReference": 0}
        found = self._values.described(evaluated(text, node, may_write=is_console), node)
        return {"result": found["value"]} | found

    def _held(self) -> Stop:
        if (stop := self._debugger.held) is None:
            raise _NotNowError("the tree runs; pause it, or wait for a breakpoint")
        return stop

    def _node(self, uid: int) -> Node:
        self._held()
        if not 0 < uid <= len(self._tree.nodes):
            raise _NotNowError(f"there is no frame {uid}")
        return self._tree.nodes[uid - 1]
