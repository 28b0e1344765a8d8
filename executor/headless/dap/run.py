"""Runs a project in lock-step for a client of the Debug Adapter Protocol."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from executor.headless.dap.lines import ENDINGS, Lines
from executor.headless.dap.paths import Folder, local_root
from executor.headless.dap.server import CAPABILITIES, Server
from executor.headless.dap.wire import GONE
from executor.headless.lockstep import LockstepOptions, LockstepRun
from tree_gardener.debugging import Debugger, DebuggingEnded

if TYPE_CHECKING:
    from pathlib import PurePath

    from executor.headless.dap.wire import Request, Wire
    from executor.headless.guard import Guard
    from executor.headless.report import Report
    from translator import Project

__all__ = ["DapRun", "Launch", "LaunchError", "launched"]

NOT_YET = "launch a project first"
MOST_FILES = 2000
LARGEST_FILE = 8 << 20


class LaunchError(ValueError):
    """The arguments of `launch` are wrong; the text says which."""


@dataclass
class Launch:
    """The request of a client that begins a run.

    Attributes:
        request: answered when the tree is loaded.
        first_line: the number that the client gives to the first line of a file.
        project: the folder or file of the project.
        options: options of the run.
        stops: whether the tree is held before its first tick.
        local_root: the project's folder on the client's machine; None if the client runs on this one.
        is_answered: whether the client knows that the tree is loaded.
    """

    request: Request
    first_line: int
    project: Path
    options: LockstepOptions
    stops: bool
    local_root: PurePath | None = None
    is_answered: bool = False


def launched(wire: Wire) -> Launch | None:
    """Answers until the client launches a project; None if it goes before."""
    first_line = 1
    while True:
        request = wire.requests.get()
        if request.command in {GONE, "terminate"}:
            wire.respond(request)
            return None
        if request.command == "initialize":
            first_line = 0 if request.arguments.get("linesStartAt1") is False else 1
            wire.respond(request, dict(CAPABILITIES))
        elif request.command == "launch":
            try:
                return _launch(request, first_line)
            except LaunchError as error:
                wire.refuse(request, str(error))
        else:
            wire.refuse(request, NOT_YET)


def _launch(request: Request, first_line: int) -> Launch:
    name = request.text("project")
    if not name:
        raise LaunchError('launch needs "project", the folder or file of a project')
    project = Path(name).expanduser().absolute()  # the run goes to the folder of the actions
    if not project.exists():
        raise LaunchError(f"{name}: there is no such file or folder")
    duration = request.arguments.get("duration", 3600.0)
    if type(duration) not in {int, float} or not 0 <= duration <= 1e9:
        raise LaunchError('"duration" is a number of simulated seconds')
    universe = request.text("universe") or None
    if universe == "none":
        raise LaunchError("the debugger holds a simulated world; a robot outside would keep moving")
    options = LockstepOptions(
        universe, request.text("robot") or None, request.number("seed"), float(duration)
    )
    stops = request.arguments.get("stopOnEntry") is True
    root = request.arguments.get("localRoot")
    local = None if root is None else local_root(str(root))
    if root is not None and local is None:
        raise LaunchError('"localRoot" is the absolute path of the folder on the machine of the editor')
    return Launch(request, first_line, project, options, stops, local)


class DapRun:
    """A run whose world and tree are held while the client looks at them.

    Args:
        project: the project.
        launch: how it was launched.
        guard: watches for hangs; it is suspended while the tree is held.
        wire: leads to the client.
    """

    _server: Server

    def __init__(self, project: Project, launch: Launch, guard: Guard, wire: Wire) -> None:
        self._run = LockstepRun(project, launch.options, lambda line: wire.say(line, "stderr"))
        self._launch, self._guard, self._wire = launch, guard, wire
        self._run.moved = guard.moved

    def play(self) -> Report | None:
        """Runs the project; returns its report, or None if the client ends it.

        Raises:
            the errors of `run_lockstep`; the launch is not answered if it was not loaded.
        """
        run, launch = self._run, self._launch
        try:
            run.set_up()
            debugger = Debugger(self._hold, self._wire.say)
            run.tree.debug(debugger)
            folder = (launch.project if launch.project.is_dir() else launch.project.parent).resolve()
            lines = Lines(_files(folder), run.tree.nodes)
            files = Folder(folder, launch.local_root)
            self._server = Server(self._wire, run.tree, debugger, lines, files, lambda: run.world.time_s)
            self._server.first_line = launch.first_line
            launch.is_answered = True
            self._wire.respond(launch.request)
            self._wire.tell("initialized")
            self._configure()
            if launch.stops:
                debugger.request_hold()
            run.moved = self._moved
            return run.play(None, None)
        except DebuggingEnded:
            return None
        finally:
            run.close()

    def _configure(self) -> None:
        with self._guard.suspended():
            self._server.configure()

    def _moved(self) -> None:
        self._guard.moved()
        self._server.poll()

    def _hold(self, stop: Any) -> None:
        with self._guard.suspended():
            self._server.hold(stop)


def _files(folder: Path) -> dict[str, bytes]:
    """Returns the files below a folder that may have a tree, by path; links and hidden ones are left out."""
    found: dict[str, bytes] = {}
    for above, folders, names in os.walk(folder):
        folders[:] = sorted(each for each in folders if not each.startswith(".") and each != "node_modules")
        for path in (Path(above, name) for name in sorted(names)):
            if path.suffix.lower() not in ENDINGS or path.is_symlink() or not path.is_file():
                continue
            if path.stat().st_size <= LARGEST_FILE:
                found[str(path.relative_to(folder))] = path.read_bytes()
            if len(found) >= MOST_FILES:
                return found
    return found
