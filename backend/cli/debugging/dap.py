"""`bt-studio dap`: a debug adapter for behaviour trees, for VS Code and other clients of its protocol."""

from __future__ import annotations

from typing import TYPE_CHECKING

from backend.cli.shared.errors import CliError

if TYPE_CHECKING:
    from executor.headless.dap.run import Launch
    from executor.headless.dap.wire import Wire
    from executor.headless.report import Report


def dap() -> None:
    """Debugs a project with an editor: speaks the Debug Adapter Protocol on standard input and output."""
    from backend.cli.run import fix_hashes

    fix_hashes()
    from executor.headless.dap.run import launched
    from executor.headless.dap.wire import own_streams
    from executor.ros.environment import use_lockstep_environment

    use_lockstep_environment()
    with own_streams() as wire:
        launch = launched(wire)
        if launch is None:
            return
        status = _debugged(wire, launch)
    wire.tell("exited", exitCode=status)  # after all output
    wire.tell("terminated")


def _debugged(wire: Wire, launch: Launch) -> int:
    """Debugs a project; returns the exit status of its run."""
    from backend.cli.run import summary
    from translator import TranslatorError

    refused = []
    try:
        done = _play(wire, launch)
    except TranslatorError as error:
        refused = [str(found) for found in error.diagnostics]
    except CliError as error:
        refused = list(error.lines)
    else:
        wire.say("the run was ended" if done is None else summary(done))
        faults = [] if done is None else done.errors
        for fault in faults:
            wire.say(
                f"{fault.get('file') or 'tree'}:{fault.get('line') or 1}: {fault.get('message')}", "stderr"
            )
        return 1 if faults else 0
    if not launch.is_answered:
        wire.refuse(launch.request, "\n".join(refused))
    wire.say("\n".join(refused), "stderr")
    return 1


def _play(wire: Wire, launch: Launch) -> Report | None:
    from backend.cli.run import reported
    from backend.cli.shared import translation as cli
    from executor.headless.dap.run import DapRun
    from executor.headless.guard import Guard

    with reported(), Guard() as guard:
        return DapRun(cli.open_project(str(launch.project)), launch, guard, wire).play()
