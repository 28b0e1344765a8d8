"""Tunes ports of a project: a study on the seeds of the evaluation, then the best values on fresh seeds."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.evaluate import evaluate
from executor.evaluation.results import inputs_of
from executor.evaluation.summary import Summary, pair
from executor.evaluation.tuning.space import TuningError, apply
from executor.evaluation.tuning.space import today as values_today
from executor.evaluation.tuning.study import Study
from executor.evaluation.variation import port_text

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from executor.evaluation.outcome import Outcome
    from executor.evaluation.plan import Plan
    from executor.evaluation.statistics import Difference
    from executor.evaluation.tuning.space import Port, Value
    from executor.evaluation.tuning.study import Trial

FORMAT: Final = "bt-studio/tuning"
FRESH: Final = 1_000_000
"""The first seed of the comparison at the end; trials have seeds below it."""
SUCCESS: Final = "success"
BEST: Final = 3


@dataclass(frozen=True)
class Objective:
    """The rating of a trial: the rate of success, or the mean of a measure."""

    name: str = SUCCESS
    maximise: bool = True

    def rate(self, outcomes: Sequence[Outcome]) -> float | None:
        """Returns the rating of some runs, or None if no run has it."""
        counted = [outcome for outcome in outcomes if outcome.is_counted]
        if self.name == SUCCESS:
            return sum(outcome.is_success for outcome in counted) / len(counted) if counted else None
        found = [outcome.measures[self.name] for outcome in counted if self.name in outcome.measures]
        return sum(found) / len(found) if found else None

    def difference(self, older: Sequence[Outcome], newer: Sequence[Outcome]) -> Difference | None:
        """Returns the newer rating minus the older one, on the seeds that both have, with its interval."""
        pairs = pair(older, newer)
        if self.name == SUCCESS:
            return pairs.difference
        return pairs.measures[self.name][1] if self.name in pairs.measures else None


@dataclass(frozen=True)
class Candidate:
    """Values on the fresh seeds; those of today have no `trial`."""

    trial: Trial | None
    outcomes: tuple[Outcome, ...]
    rating: float | None
    difference: Difference | None = None

    @property
    def summary(self) -> Summary:
        """The runs."""
        return Summary(self.outcomes, len(self.outcomes))


@dataclass(frozen=True)
class Tuned:
    """A study with its end: today's values and the best ones on the same fresh seeds, the best one first."""

    ports: tuple[Port, ...]
    objective: Objective
    trials: tuple[Trial, ...]
    today: Candidate
    best: tuple[Candidate, ...]

    @property
    def is_improvement(self) -> bool:
        """Whether the interval of the difference of the best values does not hold 0, on the better side."""
        found = self.best[0].difference if self.best else None
        if found is None:
            return False
        return found.low > 0 if self.objective.maximise else found.high < 0


def tune(  # noqa: PLR0913 - a study, and who listens
    plan: Plan,
    ports: Sequence[Port],
    objective: Objective,
    folder: Path,
    *,
    trials: int,
    runs: int,
    fresh_runs: int,
    seed: int = 0,
    workers: int | None = None,
    told: Callable[[Trial, Study], None] = lambda _t, _s: None,
) -> Tuned:
    """Tunes ports.

    Args:
        plan: the evaluation.
        ports: the ports, with their bounds.
        objective: the rating.
        folder: holds the study; one that it holds already continues.
        trials: the number of trials.
        runs: the number of runs of a trial, all trials on the same seeds.
        fresh_runs: the number of fresh seeds at the end.
        seed: the seed of the sampler.
        workers: as in `evaluate`.
        told: called with each trial that has ended.

    Raises:
        TuningError: Optuna is not installed, or the seeds of the trials would not be below a million.
        ThreadsError: this process has several threads.
        Interrupted: Ctrl+C ended it; the study keeps the trials that have ended.
    """
    first = plan.evaluation.seed
    if first + runs > FRESH:
        raise TuningError(f"{plan.file}: the seeds of trials have to be below {FRESH}; make `seed` smaller")
    seeds = range(first, first + runs)
    fixed = plan.evaluation.model_copy(update={"until": None, "runs": runs})
    plan = replace(plan, evaluation=fixed)

    def run(values: dict[Port, Value], chosen: range) -> tuple[Outcome, ...]:
        variant = replace(plan, project=apply(plan.project, values))
        found = evaluate(variant, chosen, workers=workers).outcomes
        return tuple(found[each] for each in sorted(found))

    def ported(values: dict[str, Value]) -> dict[Port, Value]:
        return {port: values[port.address] for port in ports}

    key = study_key(plan, ports, objective, runs=runs, seed=seed)
    study = Study(folder, key, ports, maximise=objective.maximise, seed=seed)
    try:
        study.run(
            trials,
            lambda values: objective.rate(run(ported(values), seeds)),
            lambda trial: told(trial, study),
        )
        fresh = range(FRESH, FRESH + fresh_runs)
        now = run({}, fresh)
        candidates = []
        for trial in study.best(BEST):
            outcomes = run(ported(trial.values), fresh)
            rating, difference = objective.rate(outcomes), objective.difference(now, outcomes)
            candidates.append(Candidate(trial, outcomes, rating, difference))
        sign = -1 if objective.maximise else 1
        best = sorted(
            (each for each in candidates if each.rating is not None),
            key=lambda each: sign * (each.rating or 0.0),
        )
        today = Candidate(None, now, objective.rate(now))
        return Tuned(tuple(ports), objective, tuple(study.trials), today, tuple(best))
    finally:
        study.close()


def study_key(plan: Plan, ports: Sequence[Port], objective: Objective, *, runs: int, seed: int) -> str:
    """Returns the name of a study: of another project, evaluation, port or objective it is another one."""
    text = f"{inputs_of(plan)} {runs} {seed} {objective} {sorted(map(repr, ports))}"
    return f"{plan.name}-{hashlib.sha256(text.encode()).hexdigest()[:16]}"


def tuning_data(tuned: Tuned, plan: Plan) -> dict[str, Any]:
    """Returns all that the page of a study and the panel *Evaluate* show."""
    return {
        "format": FORMAT,
        "version": 1,
        "project": plan.project.settings.name,
        "evaluation": f"{plan.name}, tuned",
        "objective": tuned.objective.name,
        "maximise": tuned.objective.maximise,
        "ports": [
            {
                "address": port.address,
                "tree": port.tree,
                "node": port.node,
                "port": port.port,
                "low": port.low,
                "high": port.high,
            }
            for port in tuned.ports
        ],
        "trials": [
            {"number": each.number, "values": each.values, "rating": each.rating} for each in tuned.trials
        ],
        "today": {"values": values_today(plan.project, tuned.ports), **_shown(tuned.today)},
        "best": [_best(each) for each in tuned.best],
        "improvement": tuned.is_improvement,
        "verdict": verdict(tuned),
    }


def verdict(tuned: Tuned) -> str:
    """Returns what the fresh seeds show, in one sentence."""
    if not tuned.best or tuned.best[0].difference is None:
        return "no improvement shown: no trial could be rated"
    value, low, high = tuned.best[0].difference
    number = "{:+.1%}" if tuned.objective.name == SUCCESS else "{:+.4g}"
    text = f"{number} (95 % interval {number} to {number})".format(value, low, high)
    runs = len(tuned.today.outcomes)
    if tuned.is_improvement:
        return f"the best values change {tuned.objective.name} by {text} on {runs} fresh seeds"
    return f"no improvement shown: {tuned.objective.name} changes by {text} on {runs} fresh seeds"


def _best(candidate: Candidate) -> dict[str, Any]:
    values = {} if candidate.trial is None else candidate.trial.values
    texts = {address: port_text(value) for address, value in values.items()}
    return {"values": values, "texts": texts, **_shown(candidate)}


def _shown(candidate: Candidate) -> dict[str, Any]:
    summary = candidate.summary
    low, high = summary.interval
    return {
        "rating": candidate.rating,
        "rate": summary.rate,
        "low": low,
        "high": high,
        "successes": summary.successes,
        "counted": summary.counted,
        "difference": None if candidate.difference is None else list(candidate.difference),
    }
