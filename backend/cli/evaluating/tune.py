"""`bt-studio tune`: looks for values of ports with which a project succeeds most often."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from collections.abc import Sequence

    from executor.evaluation.plan import Plan
    from executor.evaluation.tuning.space import Port
    from executor.evaluation.tuning.study import Study, Trial
    from executor.evaluation.tuning.tune import Objective, Tuned

MOST_TRIAL_RUNS = 50


def tune(  # noqa: PLR0913, PLR0917 - one an option
    project: Annotated[str, typer.Argument(help="A project folder, zip or name.")],
    name: Annotated[str, typer.Argument(help="The evaluation.")],
    port: Annotated[
        list[str], typer.Option(help="A port with its bounds: MainTree.Forward.lin_speed=0.1..0.6.")
    ],
    report: Annotated[Path, typer.Option(help="Folder for the study and report.html.")],
    maximise: Annotated[str | None, typer.Option(help="success, or a measure.")] = None,
    minimise: Annotated[str | None, typer.Option(help="A measure, in place of --maximise.")] = None,
    trials: Annotated[int, typer.Option(min=1, max=10_000, help="The number of trials.")] = 30,
    runs: Annotated[
        int | None, typer.Option(min=1, help="Runs of a trial; those of the evaluation, at most 50.")
    ] = None,
    fresh_runs: Annotated[
        int | None, typer.Option(min=1, help="Fresh seeds at the end; as many as the evaluation has runs.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the sampler that proposes values.")] = 0,
    workers: Annotated[int | None, typer.Option(min=1, max=1024, help="As in `evaluate`.")] = None,
    apply: Annotated[  # noqa: FBT002
        bool, typer.Option("--apply", help="Write the best values into the tree, if they are an improvement.")
    ] = False,
) -> None:
    """Tunes ports: a study by Optuna, then the best three values on fresh seeds, beside today's values.

    A study that the folder holds already continues. Exit status: 0, 1 if it was interrupted, 2 for bad
    arguments.
    """
    from backend.cli.evaluating.one_run import open_plan
    from backend.cli.run import fix_hashes
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from backend.cli.shared.progress import show_progress
    from executor.evaluation.pool.environment import SINGLE

    if maximise is not None and minimise is not None:
        raise typer.BadParameter("leave out one of the two", param_hint="--maximise / --minimise")
    if apply and not Path(project).is_dir():
        raise typer.BadParameter("it writes into a folder; this project is none", param_hint="--apply")
    fix_hashes(SINGLE)
    plan = open_plan(project, name)
    objective = _objective(plan, maximise, minimise)

    from executor.evaluation.evaluate import Interrupted, ThreadsError
    from executor.evaluation.tuning.space import TuningError, read_ports
    from executor.evaluation.tuning.tune import tune as run_study

    try:
        ports = read_ports(port, plan)
        if apply and (other := _other_tree(project, plan, ports)) is not None:
            text = f"it writes into the files of the trees, and there is no {other}; import the project first"
            raise typer.BadParameter(text, param_hint="--apply")
        tuned = run_study(
            plan,
            ports,
            objective,
            report,
            trials=trials,
            runs=runs or min(plan.evaluation.most_runs, MOST_TRIAL_RUNS),
            fresh_runs=fresh_runs or plan.evaluation.most_runs,
            seed=seed,
            workers=workers,
            told=lambda trial, study: _told(trial, study, trials, objective),
        )
    except TuningError as error:
        raise CliError(f"bt-studio: {error}", status=BAD_ARGUMENTS) from error
    except ThreadsError as error:
        raise CliError(f"bt-studio: {error}") from error
    except Interrupted:
        words = shlex.join(["bt-studio", *sys.argv[1:]])
        raise CliError(f"interrupted; the trials that have ended are kept. To continue: {words}") from None
    finally:
        show_progress("")
    _finish(plan, tuned, report)
    if apply:
        write_best(project, plan, tuned)


def _objective(plan: Plan, maximise: str | None, minimise: str | None) -> Objective:
    from executor.evaluation.tuning.tune import SUCCESS, Objective

    wanted = minimise or maximise or SUCCESS
    items = plan.evaluation.judge.success
    numbers = {name for item in items for name in (*item.at_least, *item.at_most)}
    known = [SUCCESS, *plan.evaluation.judge.measure, *sorted(numbers)]
    if wanted not in known:
        hint = "--maximise" if minimise is None else "--minimise"
        raise typer.BadParameter(f"{wanted!r} is not measured; there are {', '.join(known)}", param_hint=hint)
    return Objective(wanted, minimise is None)


def _told(trial: Trial, study: Study, trials: int, objective: Objective) -> None:
    from backend.cli.shared.progress import show_progress

    best = study.best(1)
    text = f"{trial.number + 1} of {trials} trials"
    if best:
        text += f"  best {objective.name} {best[0].rating:.4g} at {_values(best[0].values)}"
    show_progress(text)


def _values(values: dict[str, float | int]) -> str:
    return ", ".join(f"{address} = {value:.4g}" for address, value in values.items())


def _finish(plan: Plan, tuned: Tuned, report: Path) -> None:
    """Prints and writes the results."""
    import json

    from backend.cli.shared.translation import write_file
    from executor.evaluation.report import page_html
    from executor.evaluation.tuning.tune import tuning_data, verdict

    for title, candidate in [("today", tuned.today), *(("best ", each) for each in tuned.best)]:
        low, high = candidate.summary.interval
        rating = "undefined" if candidate.rating is None else f"{candidate.rating:.4g}"
        values = "" if candidate.trial is None else f"  {_values(candidate.trial.values)}"
        print(
            f"{title}  {tuned.objective.name} {rating} on fresh seeds "
            f"(success {candidate.summary.rate:.1%}, 95 % interval {low:.1%} to {high:.1%}){values}"
        )
    print(verdict(tuned))
    document = tuning_data(tuned, plan)
    text = json.dumps(document, ensure_ascii=False, indent=2) + "\n"
    write_file(report / "tuning.json", text.encode())
    write_file(report / "report.html", page_html(document, "tuning").encode())
    print(f"results: {report / 'report.html'}")


def write_best(project: str, plan: Plan, tuned: Tuned) -> None:
    """Writes the best values into the trees of a folder, if they are an improvement.

    Raises:
        CliError: a tree cannot be written, or was changed since the study began.
    """
    from backend.cli.shared.errors import CliError
    from backend.cli.shared.translation import write_file
    from executor.evaluation.tuning.edit import edited_trees

    if not tuned.is_improvement:
        print("nothing was written: no improvement is shown")
        return
    trial = tuned.best[0].trial
    assert trial is not None  # noqa: S101 - the best ones are trials
    values = {port: trial.values[port.address] for port in tuned.ports}
    if (other := _other_tree(project, plan, tuned.ports)) is not None:
        raise CliError(
            f"{other}:1:1: it was changed during the study, so nothing was written: set "
            f"{_values(trial.values)} by hand"
        )
    for path, data in edited_trees(plan.project, values).items():
        write_file(Path(project, path), data)
        print(f"written: {Path(project, path)}")


def _other_tree(project: str, plan: Plan, ports: Sequence[Port]) -> Path | None:
    """Returns a file of a tuned tree that is not the one that was read, or None."""
    from translator.diagram import diagram_path

    for path in sorted({diagram_path(port.tree) for port in ports}):
        on_disk = Path(project, path)
        if not on_disk.is_file() or on_disk.read_bytes() != plan.project.files.get(path):
            return on_disk
    return None
