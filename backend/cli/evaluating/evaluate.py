"""`bt-studio evaluate`: runs an evaluation of a project on all processors, with its statistics and gates."""

from __future__ import annotations

import dataclasses
import shlex
import sys
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

if TYPE_CHECKING:
    from collections.abc import Sequence

    from executor.evaluation.evaluate import Progress
    from executor.evaluation.gates import Gate, Verdict
    from executor.evaluation.outcome import Outcome
    from executor.evaluation.plan import Plan
    from executor.evaluation.pool.worker import Done
    from executor.evaluation.results import Results
    from executor.evaluation.summary import Apart, Pairs, Summary

ONLY_FAILED = "only-failed"
AGAINST = "against"


class _Where(NamedTuple):
    """Where runs run: on so many processors of this machine, or on a cluster."""

    workers: int | None
    cluster: str | None


def evaluate(  # noqa: PLR0913, PLR0917 - one an option
    project: Annotated[str, typer.Argument(help="A project folder, zip or name.")],
    name: Annotated[str | None, typer.Argument(help="The evaluation; needed if there are several.")] = None,
    as_list: Annotated[bool, typer.Option("--list", help="List the evaluations.")] = False,  # noqa: FBT002
    runs: Annotated[int | None, typer.Option(min=1, help="Runs in place of the evaluation's number.")] = None,
    seeds: Annotated[str | None, typer.Option(help="These seeds alone, such as 3,17.")] = None,
    only_failed: Annotated[  # noqa: FBT002
        bool, typer.Option("--only-failed", help="The seeds alone that failed in the results of --report.")
    ] = False,
    workers: Annotated[
        int | None, typer.Option(min=1, max=1024, help="Runs at a time; one a processor without it.")
    ] = None,
    cluster: Annotated[
        str | None,
        typer.Option(help="Run on a Ray cluster: its address, or auto for this machine's own."),
    ] = None,
    against: Annotated[
        str | None,
        typer.Option(help="An older version to compare with: a folder, a revision of git, or NAME@7."),
    ] = None,
    own_world: Annotated[  # noqa: FBT002
        bool,
        typer.Option(
            "--own-world", help="With --against: each version in its own world; nothing is paired then."
        ),
    ] = False,
    gate: Annotated[
        list[str] | None,
        typer.Option(help="success>=0.95, rate(success)>=0.95, p95(MEASURE)<=12 or no-worse."),
    ] = None,
    junit: Annotated[Path | None, typer.Option(help="File for the results, as JUnit's XML.")] = None,
    report: Annotated[Path | None, typer.Option(help="Folder for runs.jsonl and report.html.")] = None,
    resume: Annotated[  # noqa: FBT002
        bool, typer.Option("--resume", help="Keep the runs that --report holds, and run the others.")
    ] = False,
    strict: Annotated[  # noqa: FBT002
        bool, typer.Option("--strict", help="Refuse to continue results of another platform.")
    ] = False,
    judged_by: Annotated[
        str | None,
        typer.Option("--judged-by", help="The project whose evaluation, universe, robot and judge count."),
    ] = None,
    sealed: Annotated[  # noqa: FBT002
        bool,
        typer.Option("--sealed", help="Keep tree and actions in a process that sees nothing of the judge."),
    ] = False,
    to_the_end: Annotated[  # noqa: FBT002
        bool, typer.Option("--to-the-end", help="Let each run take its whole time.")
    ] = False,
) -> None:
    """Evaluates a project in many seeded worlds.

    Exit status: 0 if all gates pass (without gates: if the evaluation is complete), 1 if not, 2 for bad
    arguments.
    """
    from backend.cli.evaluating.one_run import evaluations_of
    from backend.cli.run import fix_hashes, say_left_out
    from backend.cli.shared.errors import CliError
    from executor.evaluation.summary import Apart, pair
    from executor.supervision.single_threaded import SINGLE_THREADED

    fix_hashes(SINGLE_THREADED)
    if as_list:
        for each in evaluations_of(judged_by or project):
            print(each)
        return
    if (resume or only_failed) and report is None:
        raise typer.BadParameter("name the folder of the results", param_hint="--report")
    if sum((runs is not None, seeds is not None, only_failed)) > 1:
        raise typer.BadParameter("leave out all but one", param_hint="--runs / --seeds / --only-failed")
    gates = _read_gates(gate or [])
    plan = _plan(
        project, name, runs, judged_by, to_the_end=to_the_end, is_part=seeds is not None or only_failed
    )
    say_left_out(plan.project)
    plan = _sealed(plan) if sealed else plan
    chosen = _seeds(plan, seeds, report if only_failed else None)
    if report is not None:
        report = report / ONLY_FAILED if only_failed else report
        if not (resume or only_failed):
            _require_new(report)
    is_part = runs is not None or seeds is not None or only_failed
    older = None if against is None else _older_plan(plan, project, against, own_world=own_world)
    _require_pairs(gates, against, judged_by, own_world=own_world)
    _warn(gates, plan, len(chosen))
    results, kept = _open_results(plan, report, chosen, resume=resume, strict=strict)
    where = _Where(workers, cluster)
    progress, is_interrupted = _run(plan, chosen, where, kept, results)
    summary = progress.summary(chosen, sequential=plan.evaluation.until is not None)
    pairs: Pairs | Apart | None = None
    if older is not None and not is_interrupted:
        folder = None if report is None else report / AGAINST
        seeds_run = [outcome.seed for outcome in summary.outcomes]
        if own_world and not is_part:
            seeds_run = _seeds(older, None, None)
        before, is_interrupted = _run_older(older, seeds_run, where, folder, resume=resume, strict=strict)
        pairs = Apart(before, summary) if own_world else pair(before.outcomes, summary.outcomes)
    verdicts = _finish(plan, project, summary, gates, results, pairs)
    if junit is not None:
        from backend.cli.evaluating.junit import junit_xml
        from backend.cli.shared.translation import write_file

        write_file(junit, junit_xml(plan.name, summary, verdicts))
    if is_interrupted:
        raise CliError(_how_to_continue(report))
    if not (all(verdict.passes for verdict in verdicts) if verdicts else summary.is_complete):
        raise CliError()


def _read_gates(texts: Sequence[str]) -> list[Gate]:
    from executor.evaluation.gates import GateError, read_gate

    try:
        return [read_gate(text) for text in texts]
    except GateError as error:
        raise typer.BadParameter(str(error), param_hint="--gate") from error


def _plan(  # noqa: PLR0913 - as the options say
    project: str,
    name: str | None,
    runs: int | None,
    judged_by: str | None,
    *,
    to_the_end: bool,
    is_part: bool,
) -> Plan:
    """Returns the plan; a number of runs or seeds from the command line replaces `runs` and `until`."""
    from backend.cli.evaluating.one_run import evaluations_of, open_plan
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

    if name is None:
        owner = judged_by or project
        names = evaluations_of(owner)
        if len(names) != 1:
            there = f"name one of {', '.join(names)}" if names else "write evaluations/main.yaml"
            raise CliError(
                f"{owner}:1:1: there are {len(names)} evaluations: {there}",
                status=BAD_ARGUMENTS,
            )
        name = names[0]
    plan = open_plan(project, name, judged_by=judged_by)
    evaluation = plan.evaluation
    if runs is not None or is_part:
        evaluation = evaluation.model_copy(update={"until": None, "runs": runs or evaluation.most_runs})
    return dataclasses.replace(plan, evaluation=evaluation, to_the_end=to_the_end)


def _sealed(plan: Plan) -> Plan:
    from backend.cli.evaluating.one_run import explained
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from executor.evaluation.plan import sealed
    from executor.evaluation.sealed.confine import SealError

    try:
        with explained():
            return sealed(plan)
    except SealError as error:
        raise CliError(f"bt-studio: {error}", status=BAD_ARGUMENTS) from error


def _require_pairs(
    gates: Sequence[Gate], against: str | None, judged_by: str | None, *, own_world: bool
) -> None:
    """Refuses what only pairs could answer, and what has no older version."""
    if against is None and own_world:
        raise typer.BadParameter("name the older version with --against", param_hint="--own-world")
    if own_world and judged_by is not None:
        raise typer.BadParameter("leave out one of both", param_hint="--own-world / --judged-by")
    if not any(each.kind == "no-worse" for each in gates):
        return
    if against is None:
        raise typer.BadParameter("name the older version with --against", param_hint="--gate no-worse")
    if own_world:
        raise typer.BadParameter(
            "it needs pairs, and runs in different worlds are none: leave out --own-world",
            param_hint="--gate no-worse",
        )


def _older_plan(plan: Plan, project: str, against: str, *, own_world: bool) -> Plan:
    """Returns the plan of the older version, in the worlds of the newer one or in its own."""
    from backend.cli.evaluating.against import open_older, open_older_alone
    from backend.cli.evaluating.one_run import explained
    from executor.evaluation.plan import make_plan

    with explained():
        if own_world:
            older = make_plan(open_older_alone(project, against), plan.name)
            older = dataclasses.replace(older, to_the_end=plan.to_the_end, sealed=plan.sealed)
        else:
            older = plan.with_project(open_older(plan.project, project, against))
    evaluation = older.evaluation.model_copy(update={"until": None, "runs": older.evaluation.most_runs})
    return dataclasses.replace(older, evaluation=evaluation)


def _run_older(  # noqa: PLR0913 - as the options say
    plan: Plan, seeds: Sequence[int], where: _Where, folder: Path | None, *, resume: bool, strict: bool
) -> tuple[Summary, bool]:
    """Runs the older version on seeds; returns its results, and whether Ctrl+C ended it."""
    is_begun = folder is not None and (folder / "evaluation.json").exists()
    results, kept = _open_results(plan, folder, seeds, resume=resume and is_begun, strict=strict)
    print("the older version:", flush=True)
    progress, is_interrupted = _run(plan, seeds, where, kept, results)
    summary = progress.summary(seeds, sequential=False)
    if results is not None:
        results.finish(summary.outcomes)
    return summary, is_interrupted


def _seeds(plan: Plan, listed: str | None, failed_in: Path | None) -> list[int]:
    from executor.evaluation.document import LAST_SEED
    from executor.evaluation.results import Results, ResultsError

    if listed is not None:
        try:
            found = sorted({int(part) for part in listed.split(",")})
        except ValueError:
            raise typer.BadParameter("write numbers, such as 3,17", param_hint="--seeds") from None
        if not 0 <= found[0] <= found[-1] <= LAST_SEED:
            raise typer.BadParameter(f"a seed is 0 to {LAST_SEED}", param_hint="--seeds")
        return found
    if failed_in is not None:
        try:
            earlier = Results(failed_in).outcomes()
        except ResultsError as error:
            raise typer.BadParameter(str(error), param_hint="--report") from error
        found = [outcome.seed for outcome in earlier if not outcome.is_success]
        if not found:
            raise typer.BadParameter(f"no run of {failed_in} failed", param_hint="--only-failed")
        return found
    first = plan.evaluation.seed
    return list(range(first, first + plan.evaluation.most_runs))


def _require_new(report: Path) -> None:
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from executor.evaluation.results import Results, ResultsError

    try:
        Results(report).require_none()
    except ResultsError as error:
        raise CliError(str(error), status=BAD_ARGUMENTS) from error


def _warn(gates: Sequence[Gate], plan: Plan, runs: int) -> None:
    from executor.evaluation.gates import warnings

    items = plan.evaluation.judge.success
    named = {name for item in items for name in (*item.at_least, *item.at_most)}
    for gate in gates:
        for line in warnings(gate, runs, {*plan.evaluation.judge.measure, *named}):
            print(f"warning: {line}", file=sys.stderr)


def _open_results(
    plan: Plan, folder: Path | None, seeds: Sequence[int], *, resume: bool, strict: bool
) -> tuple[Results | None, list[Outcome]]:
    """Returns the folder of results, with the outcomes that are kept."""
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from executor.evaluation.fingerprint import fingerprint
    from executor.evaluation.report import world_of
    from executor.evaluation.results import Results, ResultsError, inputs_of, kept_outcomes

    if folder is None:
        return None, []
    results = Results(folder)
    mine = fingerprint()
    prints = [mine]
    kept: list[Outcome] = []
    try:
        if resume:
            kept, prints, notes = kept_outcomes(results, plan, mine)
            for note in notes:
                print(f"warning: {note}", file=sys.stderr)
            if notes and strict:
                raise CliError("the results are of another platform (--strict)", status=BAD_ARGUMENTS)
        results.begin(
            {
                "project": plan.project.settings.name,
                "evaluation": plan.name,
                "inputs": inputs_of(plan),
                "universe": world_of(plan.universe)["version"],
                "seeds": len(seeds),
                "to_the_end": plan.to_the_end,
                "sealed": plan.sealed,
                "fingerprints": prints,
            },
            kept,
        )
    except ResultsError as error:
        raise CliError(str(error), status=BAD_ARGUMENTS) from error
    return results, kept


def _run(
    plan: Plan, seeds: Sequence[int], where: _Where, kept: Sequence[Outcome], results: Results | None
) -> tuple[Progress, bool]:
    """Runs the remaining seeds; returns all outcomes, and whether Ctrl+C ended it."""
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from backend.cli.shared.progress import show_progress
    from executor.evaluation.cluster.ray_pool import ClusterError
    from executor.evaluation.evaluate import Interrupted, ThreadsError, evaluate

    def told(progress: Progress, done: Done | None) -> None:
        if done is None:
            return
        if results is not None:
            results.add(done.outcome)
        if len(progress.cpu_s) == 1:
            show_progress("")
            print(progress.estimate(), flush=True)
        show_progress(progress.line(sequential=plan.evaluation.until is not None))

    try:
        return evaluate(
            plan, seeds, workers=where.workers, cluster=where.cluster, kept=kept, told=told
        ), False
    except Interrupted as interrupted:
        return interrupted.progress, True
    except (ThreadsError, ClusterError) as error:
        raise CliError(f"bt-studio: {error}", status=BAD_ARGUMENTS) from error
    finally:
        show_progress("")


def _finish(  # noqa: PLR0913, PLR0917 - all that the results are of
    plan: Plan,
    project: str,
    summary: Summary,
    gates: Sequence[Gate],
    results: Results | None,
    pairs: Pairs | Apart | None,
) -> list[Verdict]:
    """Prints and writes the results; returns the verdicts of the gates."""
    from executor.evaluation.gates import check_gate
    from executor.evaluation.report import command_of, report_data, report_html, world_of
    from executor.evaluation.summary import Pairs
    from executor.headless.left_out import left_out

    for line in summary.lines(plan.name):
        print(line)
    world = world_of(plan.universe)
    print(f"    in the universe “{world['name']}”, version {world['version']}")
    for outcome in summary.worst()[:3]:
        print(f"    seed {outcome.seed} {outcome.outcome} after {outcome.end_s:.1f} s: {outcome.why}")
        print(f"        {command_of(project, plan.name, outcome.seed, plan.judged_by)}")
    for line in pairs.lines() if pairs is not None else ():
        print(line)
    paired = pairs if isinstance(pairs, Pairs) else None
    verdicts = [check_gate(gate, summary, paired) for gate in gates]
    for verdict in verdicts:
        print(verdict)
    if results is not None:
        results.finish(summary.outcomes)
        header = results.header()
        document = report_data(
            summary,
            plan.universe,
            project=plan.project.settings.name,
            path=project,
            evaluation=plan.name,
            gates=[(str(verdict), verdict.passes) for verdict in verdicts],
            pairs=pairs,
            fingerprints=[each["id"] for each in header["fingerprints"]],
            judged_by=plan.judged_by,
            notes=left_out(plan.project.files),
        )
        results.write("report.html", report_html(document))
        print(f"results: {results.folder / 'report.html'}")
    return verdicts


def _how_to_continue(report: Path | None) -> str:
    if report is None:
        return "interrupted; with --report DIR, what is done is kept, and --resume continues"
    words = ["bt-studio", *sys.argv[1:]]
    command = shlex.join(words if "--resume" in words else [*words, "--resume"])
    return f"interrupted; what is done is kept. To continue: {command}"
