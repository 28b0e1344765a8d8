"""`bt-studio debug`: runs a project in lock-step under a debugger in the terminal."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from executor.headless.lockstep import LockstepOptions
    from executor.headless.report import Report
    from translator import Project


def debug(
    project: Annotated[str, typer.Argument(help="A project folder, zip or name.")],
    universe: Annotated[str | None, typer.Option(help="Universe in place of the project's.")] = None,
    robot: Annotated[str | None, typer.Option(help="Robot in place of the project's.")] = None,
    duration: Annotated[float, typer.Option(min=0.0, help="Simulated seconds.")] = 3600.0,
    seed: Annotated[int, typer.Option(help="Of all that is random, as in `run --lockstep`.")] = 0,
) -> None:
    """Debugs a project: breakpoints, steps and forced results; the simulated world waits while it is held."""
    from backend.cli.run import fix_hashes, summary
    from backend.cli.shared import translation as cli
    from translator import TranslatorError

    if universe == "none":
        text = "the debugger holds a simulated world; a robot outside would keep moving"
        raise typer.BadParameter(text, param_hint="--universe")
    fix_hashes()
    from executor.headless.lockstep import LockstepOptions

    try:
        opened = cli.open_project(project)
        done = _play(opened, LockstepOptions(universe, robot, seed, duration))
    except TranslatorError as error:
        raise cli.fail(error.diagnostics, as_json=False) from error
    print("the run was ended" if done is None else summary(done))


def _play(project: Project, options: LockstepOptions) -> Report | None:
    from backend.cli.run import reported
    from executor.headless.debug.run import DebugRun
    from executor.headless.guard import Guard
    from executor.ros.environment import use_lockstep_environment

    use_lockstep_environment()
    commands = None if sys.stdin.isatty() else sys.stdin
    with reported(), Guard() as guard:
        return DebugRun(project, options, guard, commands).play()
