"""`bt-studio tune`: looks for values of ports with which a project succeeds most often."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from executor.evaluation.plan import Plan
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
    from executor.supervision.single_threaded import SINGLE_THREADED

    if maximise is not None and minimise is not None:
        raise typer.BadParameter("leave out one of the two", param_hint="--maximise / --minimise")
    if apply and not Path(project).is_dir():
        raise typer.BadParameter("it writes into a folder; this project is none", param_hint="--apply")
    fix_hashes(SINGLE_THREADED)
    plan = open_plan(project, name)
    objective = _objective(plan, maximise, minimise)

    from executor.evaluation.evaluate import Interrupted, ThreadsError
    from executor.evaluation.tuning.space import TuningError, read_ports
    from executor.evaluation.tuning.tune import tune as run_study

    try:
        tuned = run_study(
            plan,
            read_ports(port, plan),
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
        _say("")
    _finish(plan, tuned, report)
    if apply:
        _apply(project, plan, tuned)


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
    best = study.best(1)
    text = f"{trial.number + 1} of {trials} trials"
    if best:
        text += f"  best {objective.name} {best[0].rating:.4g} at {_values(best[0].values)}"
    _say(text)


def _values(values: dict[str, float | int]) -> str:
    return ", ".join(f"{address} = {value:.4g}" for address, value in values.items())


def _say(text: str) -> None:
    """Rewrites the progress line, if the output is a terminal."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\x1b[K{text}")
        sys.stderr.flush()


def _finish(plan: Plan, tuned: Tuned, report: Path) -> None:
    """Prints and writes the results."""
    import json

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
    (report / "tuning.json").write_text(json.dumps(document, ensure_ascii=False, indent=2) + "\n", "utf-8")
    (report / "report.html").write_text(page_html(document, "tuning"), "utf-8")
    print(f"results: {report / 'report.html'}")


def _apply(project: str, plan: Plan, tuned: Tuned) -> None:
    """Writes the best values into the trees of a folder, if they are an improvement."""
    from executor.evaluation.tuning.edit import edited_trees

    if not tuned.is_improvement:
        print("nothing was written: no improvement is shown")
        return
    trial = tuned.best[0].trial
    assert trial is not None  # noqa: S101 - the best ones are trials
    values = {port: trial.values[port.address] for port in tuned.ports}
    for path, data in edited_trees(plan.project, values).items():
        target = Path(project, path)
        temporary = target.with_name(f".{target.name}.part")
        temporary.write_bytes(data)
        temporary.replace(target)
        print(f"written: {target}")
