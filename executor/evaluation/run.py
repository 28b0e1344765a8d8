"""One run of an evaluation, in lock-step: draws the world, runs, judges, and returns the outcome."""

from __future__ import annotations

import hashlib
import traceback
import types
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.action_faults import switch_action
from executor.evaluation.clearance import Clearance, Placement, bodies_to
from executor.evaluation.faults import Faults
from executor.evaluation.judge import JudgeError, Referee, Verdict, make_items
from executor.evaluation.outcome import ERROR, INVALID, SUCCESS, Outcome, letters_of
from executor.evaluation.plan import python_file
from executor.evaluation.truth import Bump, Sample, Truth
from executor.evaluation.variation import InvalidRunError, draw_world
from executor.headless.errors import HeadlessError
from executor.headless.lockstep import LockstepOptions, LockstepRun
from executor.ros.environment import use_lockstep_environment
from executor.world.physics.bullet import BulletWorld
from tree_gardener.errors import LoadError, TickError, describe

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from executor.evaluation.judge import Decision, Python
    from executor.evaluation.plan import Plan
    from executor.evaluation.variation import Drawn
    from executor.robots.config import RobotConfig
    from executor.world.physics.collision import Collision

JUDGE_EVERY: Final = 12  # steps: 20 times a simulated second
BEYOND_S: Final = 0.1  # the judge ends the run, at its first sample that is not before the end
AFTER_S: Final = 1.0  # a recorded run continues for so long, so that the moment of its decision is within it
MOST_BUMPS: Final = 50
PATH_POINTS: Final = 200
PATH_PERIOD_S: Final = 0.5


class _Decided(BaseException):
    """Ends a run that is decided, also while an action waits; actions would catch an `Exception`."""


def run_cell(  # noqa: PLR0913 - a run, and who listens to it
    plan: Plan,
    seed: int,
    *,
    recording: Path | None = None,
    moved: Callable[[], None] = lambda: None,
    progress: Callable[[float], None] | None = None,
    say: Callable[[str], None] = lambda _: None,
) -> Outcome:
    """Runs one seed of an evaluation in this process.

    Args:
        plan: the evaluation.
        seed: the seed of all that is random.
        recording: the file of the recording, if there is to be one.
        moved: called after each step of the world.
        progress: called with the simulated time, about once in each simulated second.
        say: called with each warning.

    Raises:
        HeadlessError: the recording cannot be written.
    """
    use_lockstep_environment()
    run = _make_run(plan, seed, recording, say)
    run.heard = moved
    try:
        return run.run(progress)
    finally:
        run.close()


def actions_seed(seed: int) -> int:
    """Returns the seed of the random numbers of actions, which tells nothing of the seed of the run."""
    return int.from_bytes(hashlib.sha256(f"actions {seed}".encode()).digest()[:8], "big")


def _make_run(plan: Plan, seed: int, recording: Path | None, say: Callable[[str], None]) -> EvaluationRun:
    if not plan.sealed:
        return EvaluationRun(plan, seed, recording, say)
    from executor.evaluation.sealed.run import SealedRun  # noqa: PLC0415 - it derives from this module's class

    if recording is not None:
        raise HeadlessError("a sealed run is not recorded: play its seed unsealed")
    return SealedRun(plan, seed, say)


class EvaluationRun(LockstepRun):
    """The run of one seed."""

    def __init__(self, plan: Plan, seed: int, recording: Path | None, say: Callable[[str], None]) -> None:
        evaluation = plan.evaluation
        self._after_s = AFTER_S if recording is not None else 0.0
        options = LockstepOptions(
            universe=evaluation.universe,
            robot=evaluation.robot,
            seed=seed,
            duration_s=evaluation.duration_s + BEYOND_S + self._after_s + 1 / plan.project.settings.tick_hz,
            on_finish="stop",
            recording=recording,
            outlasts_tree=True,
            actions_seed=actions_seed(seed),
        )
        super().__init__(plan.project, options, say)
        self.heard: Callable[[], None] = lambda: None
        self._plan = plan
        self._seed = seed
        self._drawn: Drawn | None = None
        self._truth = Truth({name: area.corners for name, area in plan.universe.areas.items()})
        self._faults: Faults | None = None
        self._decision: Decision | None = None
        self._verdicts: list[Verdict] = []
        self._measures: dict[str, float] = {}
        self._path: list[list[float]] = []
        self._seen: dict[str, str] = {}
        self._energy_due = "energy_j" in evaluation.judge.measure

    def run(self, progress: Callable[[float], None] | None) -> Outcome:
        """Runs the seed, and returns its outcome."""
        try:
            self.set_up()
            self._begin()
            self.play(progress, None)
        except _Decided:
            pass
        except InvalidRunError as error:
            return Outcome(self._seed, INVALID, str(error))
        except LoadError as error:
            return self.outcome_of(ERROR, str(error.diagnostics[0]))
        except TickError as error:
            if not self._is_settled:
                return self.outcome_of(ERROR, _place(error.file, error.line, error.path, error.message))
        except JudgeError as error:
            return self.outcome_of(ERROR, str(error))
        if self._decision is not None:
            return self.outcome_of(self._decision.outcome, self._decision.why)
        return self.outcome_of(ERROR, self.error_text())

    def make_world(self, assets: Path) -> BulletWorld:
        """Returns the world of the seed; the ports of the project are drawn with it."""
        plan, seed = self._plan, self._seed
        probe: list[tuple[BulletWorld, Placement]] = []

        def overlaps(universe: Any, id_: str, ignored: frozenset[str]) -> bool:
            if not probe:
                world = BulletWorld(universe, seed=seed, assets=assets, configs=plan.configs)
                probe.append((world, Placement(world)))
            placement = probe[0][1]
            for thing in (*universe.models, *universe.robots):
                placement.move(thing.id, thing.pose)
            return placement.overlaps(id_, ignored)

        try:
            drawn = draw_world(plan.evaluation, plan.targets, plan.universe, seed, overlaps)
        finally:
            for world, _ in probe:
                world.close()
        self._drawn = drawn
        self._project = drawn.edited(self._project)
        configs: list[RobotConfig] = [drawn.configured(plan.configs[0]), *plan.configs[1:]]
        return BulletWorld(drawn.universe, seed=seed, assets=assets, configs=configs)

    def _begin(self) -> None:
        """Prepares the judge; the tree is loaded."""
        world = self.world
        self._robot = world.robots[0]
        self._near = Clearance(world.bullet, self._robot, bodies_to(world, "anything"))
        self._others: dict[str, Clearance] = {}
        judge = self._plan.evaluation.judge
        self._referee = Referee(
            make_items(judge, self._truth.areas, self._measure, self._function),
            self._plan.evaluation.duration_s,
        )
        self._needs_clearance = "smallest_clearance_m" in judge.measure or any(
            item.never is not None and item.never.collision for item in judge.success
        )
        self._path_period_s = max(PATH_PERIOD_S, self._plan.evaluation.duration_s / PATH_POINTS)
        world.on_collision = self._bumped
        self.moved = self._moved
        self._faults = faults = Faults(self._plan, self._seed, self)
        faults.act(0.0)
        self._look()

    def _measure(self, what: str) -> Callable[[], float | None]:
        if what == "anything":
            return lambda: self._near.smallest_m
        if what not in self._others:
            self._others[what] = Clearance(self.world.bullet, self._robot, bodies_to(self.world, what))
        clearance = self._others[what]
        return lambda: clearance.smallest_m

    def _function(self, name: str) -> Python:
        file, function = python_file(name), name.partition(":")[2]
        module = types.ModuleType(file.removesuffix(".py").replace("/", "."))
        module.__file__ = file
        source = self._project.files[file]
        _judging(file, lambda: exec(compile(source, file, "exec"), module.__dict__))  # noqa: S102 - the user's judge
        found: Any = getattr(module, function, None)
        if not callable(found):
            raise JudgeError(f"{file}:1:1: there is no function {function!r}")
        return lambda truth: _judging(file, lambda: found(truth))

    def sample(self, tick: int) -> None:
        """Adds nothing to the report: the truth holds more."""

    @property
    def _is_settled(self) -> bool:
        """Whether the outcome is known, and what happens now is only recorded."""
        return self._decision is not None and not self._plan.to_the_end

    def _moved(self) -> None:
        self.heard()
        world = self.world
        if self._decision is not None and self._is_settled:
            if world.time_s >= self._decision.at_s + self._after_s - 1e-9:
                raise _Decided
            return
        if self._faults is not None:
            self._faults.act(world.time_s)
        if self._energy_due:
            self._truth.energy_j += self._robot.wheel_power_w() * world.step_s * 4
        if round(world.time_s / world.step_s) % JUDGE_EVERY == 0:
            self._look()

    def _bumped(self, robot: str, collision: Collision) -> None:
        if robot == self._robot.id and not self._is_settled and not collision.is_hit:
            x, y, _ = self._robot.pose
            self._truth.bumps.append(Bump(collision.time_s, x, y, collision.body))

    def _look(self) -> None:
        """Adds a sample to the truth, and judges it."""
        world, robot, truth = self.world, self._robot, self._truth
        now_s = world.time_s
        x, y, yaw = robot.pose
        actors = {actor.id: actor.position for actor in world.actors}
        root = self.report.root_status if self.has_ended else "RUNNING"
        truth.samples.append(Sample(now_s, x, y, yaw, actors, root))
        truth.path_length_m = robot.distance_m
        if self._needs_clearance:
            self._near.look()
            truth.smallest_clearance_m = self._near.smallest_m
        for clearance in self._others.values():
            clearance.look()
        if now_s >= len(self._path) * self._path_period_s - 1e-9:
            self._path.append([round(value, 3) for value in (now_s, x, y)])
        if self._decision is None:
            self._decision = self._referee.look(truth)
            if self._decision is not None:
                self._settle()
        is_over = now_s >= self._plan.evaluation.duration_s - 1e-9
        if self._decision is not None and (is_over if self._plan.to_the_end else not self._after_s):
            raise _Decided

    def _settle(self) -> None:
        """Takes the measures at the moment of the decision."""
        decision, truth = self._decision, self._truth
        assert decision is not None  # noqa: S101 - the caller has just set it
        found: dict[str, float | None] = {
            "time_to_success_s": decision.at_s if decision.outcome == SUCCESS else None,
            "path_length_m": truth.path_length_m,
            "smallest_clearance_m": truth.smallest_clearance_m,
            "mean_speed_m_s": truth.path_length_m / decision.at_s if decision.at_s > 0 else None,
            "energy_j": truth.energy_j,
        }
        numbers: dict[str, float | None] = {}
        numbers.update((name, found[name]) for name in self._plan.evaluation.judge.measure)
        numbers.update(self._referee.numbers())
        self._measures = {name: round(value, 6) for name, value in numbers.items() if value is not None}
        self._verdicts = self._referee.verdicts()
        self._path.append([round(value, 3) for value in (truth.time_s, *self._robot.pose[:2])])
        self.count_seen()

    def count_seen(self) -> None:
        """Keeps the results of each node so far."""
        if self.counts:
            self._seen = letters_of(self.tree, self.counts)

    def switch_action(self, tree_id: str, node_id: str, *, on: bool) -> None:
        """Makes an action raise, or ends that."""
        switch_action(self.tree, tree_id, node_id, on=on)

    def error_text(self) -> str:
        """Returns the first error with its place."""
        for error in self.report.errors:
            return _place(error["file"], error["line"], error["node_path"], error["message"])
        return "the run ended before it was decided"

    def outcome_of(self, outcome: str, why: str) -> Outcome:
        """Returns the outcome, with all that is known of the run."""
        end_s = self._decision.at_s if self._decision is not None else self._truth.time_s
        if self._decision is None:
            self.count_seen()
        drawn: dict[str, Any] = {} if self._drawn is None else self._drawn.values
        bumps = self._truth.bumps[:MOST_BUMPS]
        return Outcome(
            self._seed,
            outcome,
            why,
            end_s=round(end_s, 6),
            items=[verdict.to_json() for verdict in self._verdicts],
            measures=self._measures,
            faults=[] if self._faults is None else self._faults.happened,
            drawn=drawn,
            path=self._path,
            bumps=[[*(round(value, 3) for value in (b.time_s, b.x, b.y)), b.body] for b in bumps],
            seen=self._seen,
        )


def _judging(file: str, call: Callable[[], Any]) -> Any:
    """Calls a judge's code.

    Raises:
        JudgeError: it raised; the error has the line.
    """
    try:
        return call()
    except (Exception, SystemExit) as error:
        lines = [
            frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == file
        ]
        line = lines[-1] if lines else getattr(error, "lineno", None)
        raise JudgeError(f"{file}:{line or 1}:1: {describe(error)}") from error


def _place(file: str | None, line: int | None, path: str | None, message: str) -> str:
    where = f"{file}:{line or 1}:1: " if file else ""
    return f"{where}{path}: {message}" if path else f"{where}{message}"
