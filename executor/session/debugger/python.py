"""The Python debugger of a session: the driver's messages to debugpy's adapter, and the hold at a line.

The driver's client sends `initialize` once. From then on the session connects each application with an
adapter of its own before its code is loaded: `initialized` comes, and the client sends its breakpoints and
`configurationDone`. `terminated` comes when the program has ended; the next one brings `initialized` again.
While the program is stopped, its main thread answers nothing, and world and tree are paused (state `held`).
"""

from __future__ import annotations

import contextlib
import secrets
from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor import child_messages, messages
from executor.adapter_messages import AdapterText, StartAdapter
from executor.session.debugger.dap import CAPABILITIES, OWN_SEQ, Refused, checked, made_by_hand, named
from executor.session.debugger.lines import with_one_condition
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.runs.recording import FlagRefused

if TYPE_CHECKING:
    from executor.session.child import Child
    from executor.session.debugger.dap import Request
    from executor.session.events import ChildExited, ChildSaid, CommandCame
    from executor.session.stage import Stage

__all__ = ["HELD_IN_PYTHON", "HELD_IN_PYTHON_HINT", "HELD_IN_PYTHON_TEXT", "PythonDebugger"]

HELD_IN_PYTHON: Final = "held_in_python"
HELD_IN_PYTHON_TEXT: Final = "The program is held at a line of Python, and answers nothing."
HELD_IN_PYTHON_HINT: Final = "Continue it first."
CHANGES: Final = frozenset({"evaluate", "setVariable"})
"""What may change a program, in the midst of whatever it does if it is not stopped."""
STEPS: Final = frozenset({"next", "stepIn", "stepOut"})
LONGEST_CHANGE: Final = 200
GOODBYE_S: Final = 2.0
LONGEST_LINE: Final = 2000
_INITIALIZE: Final = {"clientID": "bt-studio", "adapterID": "debugpy", "pathFormat": "path"}
_ATTACH: Final = {
    "connect": {"host": "127.0.0.1", "port": 0},
    "justMyCode": True,
    "redirectOutput": False,
    "subProcess": False,
}
_UNTOLD: Final = frozenset({"debugpySockets", "module", "process", "terminated"})
"""Events of the adapter that clients do not get; the session says itself when a program has ended."""


class PythonDebugger:
    """The Python debugger of a session.

    Attributes:
        client: the client that debugs; "" if none does.
        is_stopped: whether the program is stopped at a line.
        pauses: whether the run is paused once the program continues.
    """

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self.client = ""
        self.is_stopped = False
        self.pauses = False
        self._token = ""
        self._seq = OWN_SEQ
        self._of = 0
        self._is_configured = False
        self._is_told = False
        self._is_traced = True
        self._set: dict[str, bool] = {}
        self._settings = 0
        self._stop: dict[str, Any] = {}
        self._stepping_from: int | None = None
        self._last_change = ""
        self._counts_after: int | None = None
        """A beat after so many says how many ticks were whole before the first change by hand."""

    def ask(self, event: CommandCame, data: messages.Dap) -> None:
        """Handles a request of the driver's client."""
        stage = self._stage
        try:
            request = checked(data.message, stage.run.folder)
            if request.command != "initialize" and event.client != self.client:
                raise Refused("not_initialized", "The debugger was not started.", "Send initialize first.")
        except Refused as refused:
            stage.output.refuse(event, refused.code, refused.message, refused.hint)
            return
        stage.output.send(event.client, messages.Ack(), event.request)
        if request.command == "initialize":
            self._initialize(event.client, request)
        elif request.command == "disconnect":
            self._answer(request)
            self.end()
        elif not self._is_told:
            self._answer(request, "No program is connected with the debugger.")
        elif request.command == "configurationDone" and self._is_configured:
            self._answer(request)
        elif request.command in CHANGES and not self.is_stopped:
            self._answer(request, "The program is not held at a line of Python.")
        else:
            self._pass_on(request)

    def _initialize(self, client: str, request: Request) -> None:
        """Begins, or begins again for a page that was loaded again."""
        if self.client != client:
            self.end()
        self.client = client
        self._answer(request, body=CAPABILITIES)
        if self._stage.children.get("adapter") is None:
            self._of = 0
        elif self._is_told:
            self._tell("initialized")
            if self.is_stopped:
                self._tell("stopped", self._stop)

    def _pass_on(self, request: Request) -> None:
        if request.command == "configurationDone":
            self._is_configured = True
        if request.command == "continue" or request.command in STEPS:
            application = self._stage.children.get("application")
            is_step = request.command in STEPS and application is not None
            self._stepping_from = application.vitals.turns if is_step and application is not None else None
            self._counts_after = None  # it may make ticks before it says that it continues
        self._follow_breakpoints(request)
        change = made_by_hand(request)
        if change:
            self._note_change(change)
        arguments = request.arguments
        if request.command == "setBreakpoints":
            self._settings += 1
            path = arguments["source"]["path"].removeprefix(f"{self._stage.run.folder}/")
            joined = with_one_condition(arguments.get("breakpoints"), self._settings, path)
            arguments = arguments | {"breakpoints": joined}
        self._request(request.command, arguments, request.seq)

    def _follow_breakpoints(self, request: Request) -> None:
        """Stops the tracing of the program while nothing can stop it: each call of its code would cost."""
        if request.command == "setBreakpoints":
            self._set[request.arguments["source"]["path"]] = bool(request.arguments.get("breakpoints"))
        elif request.command == "setExceptionBreakpoints":
            self._set[""] = bool(request.arguments.get("filters"))
        elif request.command == "pause":
            self._set[""] = True
        elif request.command != "configurationDone":
            return
        is_traced = any(self._set.values()) or not self._is_configured
        if is_traced != self._is_traced:
            self._is_traced = is_traced
            self._stage.children.tell_application(child_messages.TracePython(is_traced))

    def _note_change(self, change: str) -> None:
        """Marks the run as changed by hand: what follows does not come from the program alone."""
        stage = self._stage
        text = f"Changed by hand in Python: {change[:LONGEST_CHANGE]}"
        stage.output.emit(messages.Log("manager", "warning", text, time=stage.sim_time_s))
        application = stage.children.get("application")
        whole = _whole_ticks(application) if application is not None else 0
        if stage.past.changed_by_hand(stage.sim_time_s, whole) and application is not None:
            self._counts_after = application.vitals.beats  # the last one may be older than this stop
        if text == self._last_change:
            return
        self._last_change = text
        with contextlib.suppress(FlagRefused):  # the line in the log says it, too
            stage.recording.flag(messages.Flag(text), stage.clients.user(self.client))

    def cannot_stop(self, message: child_messages.PythonLineWrong) -> None:
        """Reports a breakpoint that cannot do what it says: in the console, and at its line to the client."""
        stage = self._stage
        text = f"{message.path}:{message.line}: {message.text}"
        stage.output.emit(messages.Log("action", "warning", text, time=stage.sim_time_s))
        if self.client:
            place = {"source": {"path": message.path}, "line": message.line}
            self._tell(
                "breakpoint",
                {"reason": "changed", "breakpoint": {"verified": False, "message": message.text, **place}},
            )

    def _answer(self, request: Request, error: str = "", body: dict[str, Any] | None = None) -> None:
        answer: dict[str, Any] = {
            "type": "response",
            "request_seq": request.seq,
            "command": request.command,
            "success": not error,
        }
        if error:
            answer["message"] = error
        self._send(answer | ({"body": body} if body is not None else {}))

    def _tell(self, event: str, body: dict[str, Any] | None = None) -> None:
        self._send({"type": "event", "event": event, "body": body or {}})

    def _send(self, message: dict[str, Any]) -> None:
        self._seq += 1
        self._stage.output.send(self.client, messages.Dap({"seq": self._seq, **message}))

    @property
    def is_wanted(self) -> bool:
        """Whether an application that starts waits for the breakpoints of a client."""
        return bool(self.client)

    def follow(self) -> None:
        """Starts and ends adapters, as clients and applications come and go; called after each event."""
        stage = self._stage
        if self.client and stage.clients.role(self.client) != "driver":
            self.end()
        application = stage.children.get("application")
        if stage.children.get("adapter") is not None and (
            application is None or application.number != self._of
        ):
            self._detach()
        if not self.client or application is None or application.number == self._of:
            return
        if application.is_started and not application.is_stopping and not stage.children.get("adapter"):
            self._of = application.number
            self._attach()

    def _attach(self) -> None:
        stage = self._stage
        self._token = secrets.token_hex(32)
        stage.children.ensure("adapter")
        stage.children.tell_adapter(StartAdapter(self._token))
        self._request("initialize", _INITIALIZE)
        self._request("attach", _ATTACH)

    def _request(self, command: str, arguments: dict[str, Any], seq: int = 0) -> None:
        if not seq:
            self._seq += 1
        message = {"seq": seq or self._seq, "type": "request", "command": command, "arguments": arguments}
        self._stage.children.tell_adapter(AdapterText(msgspec.json.encode(message)))

    def end(self) -> None:
        """Ends the debugger: the program continues without breakpoints."""
        if self.client:
            self._detach()
            self.client = ""

    def let_go(self) -> None:
        """Ends the adapter, so that a stopped program can end."""
        if self.client:
            self._detach()

    def _detach(self) -> None:
        """Ends the adapter; a stopped program continues."""
        stage = self._stage
        if self._is_told:
            # The adapter removes all breakpoints and steps before it ends; a kill would leave a step behind.
            self._request("disconnect", {"terminateDebuggee": False})
            stage.children.tell_application(child_messages.TracePython(is_on=False))
        stage.children.drop("adapter", grace_s=GOODBYE_S)
        if self._is_told and self.client:
            self._tell("terminated")
        self._is_told = self._is_configured = False
        self._is_traced, self._set = True, {}
        self._go_on()

    def exited(self, event: ChildExited) -> None:
        """Handles the end of an adapter."""
        child = self._stage.children.of(event)
        if child is None:
            return
        del self._stage.children.living["adapter"]
        child.end(event.reason, event.last_lines)
        text = f"The Python debugger {event.reason}; the program continues without its breakpoints."
        self._stage.output.emit(messages.Log("manager", "warning", text, time=self._stage.sim_time_s))
        self._detach()

    def said(self, event: ChildSaid) -> None:
        """Handles a message of the adapter."""
        if self._stage.children.of(event) is None or not isinstance(event.message, AdapterText):
            return
        try:
            message = msgspec.json.decode(event.message.text, type=dict[str, Any])
        except (msgspec.DecodeError, RecursionError, UnicodeError):
            return
        if message.get("type") == "event":
            self._on_event(str(message.get("event")), message)
        elif message.get("type") == "response":
            self._on_response(message)

    def _on_response(self, message: dict[str, Any]) -> None:
        request = message.get("request_seq")
        if not isinstance(request, int) or request < OWN_SEQ:
            self._forward(message)
        elif message.get("success") is False:
            text = f"The Python debugger is not connected: {message.get('message')}"
            self._stage.output.emit(messages.Log("manager", "warning", text, time=self._stage.sim_time_s))
            self._detach()

    def _on_event(self, name: str, message: dict[str, Any]) -> None:
        body = message.get("body")
        body = body if isinstance(body, dict) else {}
        if name == "debugpyWaitingForServer":
            port = body.get("port")
            if isinstance(port, int):
                wanted = child_messages.ConnectDebugger(port, self._token)
                self._stage.children.tell_application(wanted)
            return
        if name in _UNTOLD or (name == "output" and body.get("category") == "telemetry"):
            return
        if name == "output" and (text := str(body.get("output", "")).strip()):
            log = messages.Log("action", "info", text[:LONGEST_LINE], time=self._stage.sim_time_s)
            self._stage.output.emit(log)
        if name == "initialized":
            self._is_told = True
        elif name == "stopped":
            self._stop = body
            self._hold()
        elif name == "continued" and self._stepping_from is None:
            self._go_on()
        elif name == "continued":
            self._step_on()
        self._forward(message)

    def _forward(self, message: dict[str, Any]) -> None:
        if self.client:
            self._stage.output.send(self.client, messages.Dap(named(message, self._stage.run.folder)))

    def _hold(self) -> None:
        """The program is stopped at a line: the world is paused, too."""
        stage, application = self._stage, self._stage.children.get("application")
        if application is None or application.is_stopping:
            return
        self._stepping_from = None
        self.is_stopped = application.is_suspended = True
        stage.children.tell_world(child_messages.Pause())
        if stage.hold.since_s is None:
            stage.hold.since_s = stage.now_s
        if stage.state in HAS_APPLICATION and stage.state is not State.HELD:
            self.pauses = stage.state is State.PAUSED
            stage.enter(State.HELD)

    def _step_on(self) -> None:
        """The program makes a step; the world waits until the step or the tick is over."""
        self.is_stopped, self._counts_after = False, None
        if (application := self._stage.children.get("application")) is not None:
            application.is_suspended = False

    def beat(self, application: Child) -> None:
        """Notes a sign of life: a step that has left the tick lets the world continue."""
        after = self._counts_after
        if after is not None and self.is_stopped and application.vitals.beats > after:
            self._counts_after = None
            self._stage.past.counted_by_hand(_whole_ticks(application))
        if self._stepping_from is not None and application.vitals.turns != self._stepping_from:
            self._stepping_from = None
            self._go_on(has_stepped=True)

    def _go_on(self, *, has_stepped: bool = False) -> None:
        """The program continues, and so does the world, unless the tree is held at a node."""
        if not (self.is_stopped or has_stepped or self._stepping_from is not None):
            return
        stage, application = self._stage, self._stage.children.get("application")
        self.is_stopped, self._stepping_from, self._counts_after = False, None, None
        if application is not None:
            application.is_suspended = False
            if application.is_holding or application.is_stopping:
                return
        stage.hold.since_s = None
        if stage.state is not State.HELD or application is None:
            return
        if self.pauses:
            self.pauses = False
            stage.enter(State.PAUSED)
            return
        stage.children.tell_world(child_messages.Resume())
        stage.enter(State.APPLICATION_RUNNING)


def _whole_ticks(application: Child) -> int:
    """Returns how many ticks a run had ended at its last sign of life within a tick."""
    return max(0, application.vitals.ticks - 1)
