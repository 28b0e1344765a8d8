"""`bt-studio run`: runs a project with its simulated world in the terminal."""

from __future__ import annotations

import json
import os
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from executor.headless.live import HeadlessOptions
    from executor.headless.lockstep import LockstepOptions
    from executor.headless.report import Report
    from translator import Project

LOCKSTEP_DURATION_S = 60.0


def run(  # noqa: PLR0913, PLR0917 - one an option
    project: Annotated[str, typer.Argument(help="A project folder, zip or name.")],
    universe: Annotated[str | None, typer.Option(help="Universe in place of the project's.")] = None,
    robot: Annotated[str | None, typer.Option(help="Robot in place of the project's.")] = None,
    duration: Annotated[
        float | None, typer.Option(min=0.0, help="Simulated seconds; 60 in lock-step, else until it ends.")
    ] = None,
    lockstep: Annotated[  # noqa: FBT002 - typer's way
        bool, typer.Option("--lockstep", help="As fast as the machine can, and always the same.")
    ] = False,
    seed: Annotated[
        int,
        typer.Option(help="Of all that is random: universe, noise, and random and numpy of the actions."),
    ] = 0,
    report: Annotated[Path | None, typer.Option(help="File for the report, as JSON.")] = None,
    evaluation: Annotated[
        str | None,
        typer.Option(help="Run one seed of this evaluation, in lock-step, and judge it."),
    ] = None,
    judged_by: Annotated[
        str | None,
        typer.Option("--judged-by", help="With --evaluation: the project that the evaluation is taken from."),
    ] = None,
    record: Annotated[
        Path | None,
        typer.Option(help="MCAP file (.mcap) for all that happens in the run."),
    ] = None,
    profile: Annotated[  # noqa: FBT002 - typer's way
        bool, typer.Option("--profile", help="Measure the time of each node, and print the slowest ones.")
    ] = False,
    groot2: Annotated[
        int | None,
        typer.Option(
            min=1, max=65534, metavar="PORT", help="Let Groot2 connect at this port; its own is 1667."
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the report as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Runs a project; exit status 1 if it cannot run, an action raised, or an action is an unwritten stub."""
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import CliError
    from translator import TranslatorError
    from translator.export import unwritten_actions
    from tree_gardener.stubs import stubs_sentence

    _refuse_contradictions(record, universe, lockstep=lockstep)
    if evaluation is not None:
        from backend.cli.evaluating.one_run import run_one

        _refuse_with_evaluation(universe, robot, duration, groot2, profile=profile)
        run_one(project, evaluation, seed, judged_by=judged_by, record=record, report=report, as_json=as_json)
        return
    if judged_by is not None:
        raise typer.BadParameter("name the evaluation with --evaluation", param_hint="--judged-by")
    if lockstep:
        fix_hashes()
    stubs: list[str] = []
    try:
        opened = cli.open_project(project)
        stubs = unwritten_actions(opened)
        if stubs and lockstep:  # otherwise the session reports the stubs
            sys.stderr.write(f"{stubs_sentence(stubs)}\n")
        if lockstep:
            from executor.headless.lockstep import LockstepOptions

            wanted = LOCKSTEP_DURATION_S if duration is None else duration
            say_left_out(opened)
            options = LockstepOptions(
                universe, robot, seed, wanted, recording=record, profiles=profile, groot2=groot2 or 0
            )
            done = _in_lockstep(opened, options)
        else:
            from executor.headless.live import HeadlessOptions

            live = HeadlessOptions(universe, seed, duration, robot, record, profile, groot2 or 0)
            done = _in_real_time(opened, live)
    except TranslatorError as error:
        raise cli.fail(error.diagnostics, as_json=as_json) from error
    document = json.dumps(done.to_json(), ensure_ascii=False, indent=2) + "\n"
    if report is not None:
        cli.write_file(report, document.encode())
    if as_json:
        sys.stdout.write(document)
    else:
        print(summary(done), *(_profile_lines(done) if profile else ()), sep="\n")
    if lockstep and not done.random and not as_json:
        print("Nothing in this run was random: every seed gives the same.")
    faults = [_fault_line(fault) for fault in done.errors]
    if faults or stubs:
        raise CliError(*faults, *(f"actions/{name}.py:1:1: stub {stubs_sentence([name])}" for name in stubs))


def _refuse_contradictions(record: Path | None, universe: str | None, *, lockstep: bool) -> None:
    if lockstep and universe == "none":
        text = "lock-step needs a simulated world; run against an outside graph in real time"
        raise typer.BadParameter(text, param_hint="--universe")
    if record is not None and record.suffix != ".mcap":
        text = f"a recording is an MCAP file, so {record.name!r} must end with .mcap"
        raise typer.BadParameter(text, param_hint="--record")


def _refuse_with_evaluation(
    universe: str | None,
    robot: str | None,
    duration: float | None,
    groot2: int | None,
    *,
    profile: bool,
) -> None:
    given = {"--universe": universe, "--robot": robot, "--duration": duration, "--groot2": groot2}
    given["--profile"] = profile or None
    for name, value in given.items():
        if value is not None:
            text = "the evaluation decides this; leave out one of the two"
            raise typer.BadParameter(text, param_hint=name)


def fix_hashes(others: Mapping[str, str] | None = None) -> None:
    """Starts the command again with `PYTHONHASHSEED=0`, which Python reads only at its start.

    Otherwise the hashes of texts differ in each process, and so does the order of sets of texts. `others` are
    further variables that libraries read when they are loaded.
    """
    wanted = {"PYTHONHASHSEED": "0", **(others or {})}
    is_command = Path(sys.argv[0]).name in {"bt-studio", "main.py"}
    if is_command and any(os.environ.get(name) != value for name, value in wanted.items()):
        sys.stdout.flush()
        environment = {**os.environ, **wanted}
        os.execve(sys.executable, [sys.executable, *sys.orig_argv[1:]], environment)  # noqa: S606 - itself


@contextmanager
def reported() -> Iterator[None]:
    """Turns the errors of a run in lock-step into errors of the command line."""
    from backend.cli.shared.errors import CliError
    from executor.headless.errors import HeadlessError
    from executor.headless.guard import Hung
    from executor.universes.document import DocumentError
    from tree_gardener import LoadError, TickError
    from tree_gardener.groot import GrootError

    try:
        yield
    except Hung as hung:
        raise CliError(str(hung)) from None
    except (DocumentError, GrootError, HeadlessError) as error:
        raise CliError(str(error)) from error
    except LoadError as error:
        raise CliError(*map(str, error.diagnostics)) from error
    except TickError as error:
        raise CliError(f"{error.file or 'tree'}:{error.line or 1}:1: {error}") from error


def say_left_out(project: Project) -> None:
    """Writes a line for each launch node that a run in simulated time leaves out.

    Raises:
        CliError: a launch file cannot be read.
    """
    from executor.headless.left_out import left_out

    with reported():
        for line in left_out(project.files):
            sys.stderr.write(f"{line}\n")


def _in_lockstep(project: Project, options: LockstepOptions) -> Report:
    from backend.cli.shared.progress import show_progress
    from executor.headless.guard import Guard
    from executor.headless.lockstep import run_lockstep

    def progress(time_s: float) -> None:
        show_progress(f"{time_s:6.1f} s of {options.duration_s:g} s")

    try:
        with reported(), Guard() as guard:
            return run_lockstep(
                project, options, progress=progress, moved=guard.moved, waiting=guard.suspended
            )
    finally:
        show_progress("")


def _in_real_time(project: Project, options: HeadlessOptions) -> Report:
    from backend.cli.shared.errors import CliError
    from backend.cli.shared.progress import show_progress
    from executor.headless.errors import HeadlessError
    from executor.headless.live import run_headless
    from translator import to_app_zip

    def progress(so_far: Report) -> None:
        show_progress(f"{so_far.sim_time_s:6.1f} s, {so_far.ticks} ticks, {so_far.distance_m:.2f} m")

    def say(line: str) -> None:
        show_progress("")
        print(line, flush=True)

    try:
        return run_headless(project, to_app_zip(project), options, progress=progress, say=say)
    except HeadlessError as error:
        raise CliError(str(error)) from error
    finally:
        show_progress("")


def summary(done: Report) -> str:
    """Returns the result of a run in one line."""
    hits = f", hit {done.hits}×" if done.hits else ""
    nearest = "" if done.min_range_m is None else f", nearest {done.min_range_m:.2f} m"
    return (
        f"{done.root_status} after {done.ticks} ticks, {done.sim_time_s:.1f} s simulated in "
        f"{done.wall_time_s:.1f} s ({done.real_time_factor:.1f}× real time); "
        f"{done.distance_m:.2f} m, {done.collisions} collisions{hits}{nearest}"
    )


def _profile_lines(done: Report) -> Iterator[str]:
    from executor.headless.profiling import lines_of

    return lines_of(done.profile)


def _fault_line(fault: dict[str, object]) -> str:
    code = f"{fault.get('kind') or fault.get('code') or 'exception'}"
    file = fault.get("file") or fault.get("node_path") or fault.get("path") or "tree"
    place = f"{file}:{fault.get('line') or 1}:1"
    return f"{place}: {code} {fault.get('message')}"
