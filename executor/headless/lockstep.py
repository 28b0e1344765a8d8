"""Runs a project with its world in one process, in lock-step: sensors, then the tick, then the actuators.

Time is simulated, so a run is deterministic and as fast as the machine allows. The application uses a real
rclpy node, as in a session: Fast DDS delivers within a process before `publish` returns, so the callbacks can
be called immediately after publishing.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from executor.headless.clock import WorldClock
from executor.headless.files import write_files
from executor.headless.lines import mismatch_line
from executor.headless.output import RecordedOutput, recorded
from executor.headless.profiling import RunProfile
from executor.headless.report import NodeCount, Report, quantiles
from executor.headless.stepper import PERIOD_STEPS, Stepper
from executor.ros.environment import use_lockstep_environment
from executor.supervision.descendants import RunChildren
from executor.supervision.scratch import Scratch

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager
    from pathlib import Path

    from executor.child_messages import Log, TopicMismatch
    from executor.headless.recorder import RunRecorder
    from executor.headless.recording import Recording
    from executor.ros.node import WorldNode
    from executor.world.physics.bullet import BulletWorld
    from executor.world.sensing.sensors import Sensors
    from translator import Project
    from tree_gardener import Status, TickError, Tree
    from tree_gardener.hooks import ResultCount
    from tree_gardener.runner import Runner

    Waiting = Callable[[], AbstractContextManager[object]]
    Progress = Callable[[float], None]
    Watch = Callable[[BulletWorld, Tree], None]

TRAJECTORY_HZ: Final = 10.0
TREE_FILE: Final = "self_contained_tree.xml"
MISMATCHES_S: Final = 5.0
TOO_LONG: Final = "an action waited in rclpy until the end of the run; let update() return RUNNING instead"


@dataclass(frozen=True)
class LockstepOptions:
    """Options of a run; None means the project's setting."""

    universe: str | None = None
    robot: str | None = None
    seed: int = 0
    duration_s: float = 60.0
    tick_hz: float | None = None
    on_finish: str | None = None
    on_error: str | None = None
    recording: Path | None = None
    outlasts_tree: bool = False
    """Whether the world continues after the root has finished."""
    profiles: bool = False
    """Whether each node is measured."""
    groot2: int = 0
    """The port at which Groot2 follows, holds and forces the tree; 0 for none."""
    actions_seed: int | None = None
    """The seed of the random numbers of actions; without it, that of the run."""


def run_lockstep(  # noqa: PLR0913 - a run, and who listens to it
    project: Project | Mapping[str, bytes] | Path,
    options: LockstepOptions | None = None,
    *,
    progress: Progress | None = None,
    watch: Watch | None = None,
    say: Callable[[str], None] | None = None,
    moved: Callable[[], None] | None = None,
    waiting: Waiting = nullcontext,
) -> Report:
    """Runs a project until its tree ends or the time is over.

    Args:
        project: an opened project, its files by path, or its path.
        options: replace settings of the project; None replaces none.
        progress: called with the simulated time, about once in each simulated second.
        watch: called before each tick with the world and the tree, for measurements.
        say: called with each warning; with None, warnings are written to standard error.
        moved: called after each step of the world.
        waiting: entered while the tree waits at a breakpoint of Groot2.

    Raises:
        TranslatorError: the project has errors.
        DocumentError: the universe or the robot does not exist or is wrong.
        LoadError: an action cannot be loaded.
        TickError: the setup of an action raised.
        HeadlessError: the recording cannot be written.
    """
    use_lockstep_environment()
    run = LockstepRun(_open(project), options or LockstepOptions(), say or _say)
    run.moved, run.waiting = moved or run.moved, waiting
    try:
        run.set_up()
        return run.play(progress, watch)
    finally:
        run.close()


class LockstepRun:
    """One run: the world, the application, and the ROS connection between them.

    Evaluations derive from it; they make another world, and end by what `moved` raises.

    Attributes:
        moved: called after each step of the world; what it raises ends the run.
        waiting: entered while the tree waits at a breakpoint of Groot2.
        world: the world, after `set_up`.
        tree: the tree, after `set_up`.
        node: the world's ROS node, after `set_up`.
        sensors: the sensors of the world, after `set_up`.
        report: the facts of the run so far.
        has_ended: whether the tree has ended.
        counts: the results of each node, in the order of the nodes; empty before `set_up`.
    """

    world: BulletWorld
    tree: Tree
    node: WorldNode
    sensors: Sensors

    def __init__(self, project: Project, options: LockstepOptions, say: Callable[[str], None]) -> None:
        settings = project.settings
        self._project = project
        self._options = options
        self._say = say
        self._tick_hz = options.tick_hz or settings.tick_hz
        self._on_finish = options.on_finish or settings.on_finish
        self._on_error = options.on_error or settings.on_error
        self.report = Report()
        self._durations: list[float] = []
        self.moved: Callable[[], None] = lambda: None
        self.waiting: Waiting = nullcontext
        self._stack: list[Callable[[], object]] = []
        self._recorder: RunRecorder | None = None  # set when the tree is loaded
        self._output: tuple[Any, Any] = (None, None)
        self._printed: list[Log] = []  # before there is a recorder
        self._profile: RunProfile | None = None
        self.has_ended = False
        self.counts: list[ResultCount] = []

    def set_up(self) -> None:
        """Makes the world and the application. Call `close` afterwards, also after an error."""
        self._stack.append(RunChildren().end)
        recording = self._open_recording(self._project)
        self.world = self.make_world(self._write_assets())
        self._stack.append(self.world.close)
        self._join_ros()
        self.tree = self._make_tree(self._project)  # making the world may have drawn ports of it
        if self._ros.navigation is not None:  # as in a session, which is paused until its tree is run
            self._ros.navigation.poll(is_paused=True)
        self._recorder = self._make_recorder(recording)
        if self._options.profiles:
            self._profile = RunProfile(self.tree, None if self._recorder is None else self._recorder.profiled)

    def play(self, progress: Progress | None, watch: Watch | None) -> Report:
        """Ticks until the end of the run, and returns its report."""
        from tree_gardener.runner import Runner  # noqa: PLC0415 - after the environment

        runner = Runner(
            self.tree,
            tick_hz=self._tick_hz,
            on_finish=self._on_finish,
            on_error=self._on_error,
            fault=self._note_fault,
            halted=self._ros.application.commanded.stop,
        )
        began_s = time.perf_counter()
        ticks = self.ticks
        for number in range(ticks):
            self._advance(round(number / self._tick_hz / self.world.step_s))
            self._call_back(runner)
            if runner.error is not None:
                self._note_end(None, runner.status)
                break
            if number % max(1, round(self._tick_hz * MISMATCHES_S)) == 1:
                self._mismatches.look()
            if watch is not None:
                watch(self.world, self.tree)
            status = self._tick(runner)
            self.node.poll()
            for note in self.node.take_notes():
                print(note, file=sys.stderr)  # noqa: T201 - what the console of a session shows
                if self._recorder is not None:
                    self._recorder.says("warning", note)
            self.sample(number)
            if progress is not None and number % max(1, round(self._tick_hz)) == 0:
                progress(self.world.time_s)
            if runner.is_finished:
                self._note_end(status, runner.status)
                if runner.error is not None or not self._options.outlasts_tree:
                    break
        else:
            self._advance(round(ticks / self._tick_hz / self.world.step_s))
            self.report.root_status = runner.status.name
        if self._profile is not None:
            self.report.profile = self._profile.end()
        if self._recorder is not None:
            self._recorder.end()
        return self._finish(began_s, runner.statistics.overruns)

    @property
    def ticks(self) -> int:
        """The number of ticks of a run that nothing ends earlier."""
        return math.floor(self._options.duration_s * self._tick_hz + 1e-9)

    def close(self) -> None:
        """Frees everything, in reverse order."""
        while self._stack:
            self._stack.pop()()

    def make_world(self, assets: Path) -> BulletWorld:
        """Returns the world; `assets` is the folder with the project's robots and meshes."""
        from executor.universes.document import text_of  # noqa: PLC0415 - as below
        from executor.world.simulation.launch import make_world  # noqa: PLC0415 - slow to load

        settings, options = self._project.settings, self._options
        universe = options.universe or settings.universe
        file = f"universes/{universe}.yaml"
        own = self._project.files.get(file)
        text = text_of(own, file) if own is not None else universe
        robot = options.robot or settings.robot
        return make_world(text, seed=options.seed, robot=robot, assets=assets, file=file)

    def _write_assets(self) -> Path:
        scratch = Scratch()
        self._stack.append(scratch.remove)
        _write_assets(self._project, scratch.path)
        return scratch.path

    def _join_ros(self) -> None:
        from executor.headless.participants import Participants  # noqa: PLC0415 - ROS reads the environment
        from executor.ros.graph.mismatches import Mismatches  # noqa: PLC0415

        self.open_sensors()
        self._ros = ros = Participants(self.world, self.make_node, self._let_time_pass)
        self._stack.append(ros.close)
        self.node = ros.node
        self.make_stepper()
        if ros.navigation is not None:
            self._stepper.parts.append(ros.navigation)
        self._mismatches = Mismatches(ros.application, self._say_mismatch, patience=1)

    def make_stepper(self) -> None:
        """Makes what steps the world, after its sensors and its node."""
        self._stepper = Stepper(self.world, self.sensors, self.node)
        self._stepper.moved = self._tell_moved
        self._stepper.published = self._record_published

    def open_sensors(self) -> None:
        """Makes the sensors of the world."""
        from executor.render import make_renderer  # noqa: PLC0415 - as below
        from executor.world.sensing.sensors import Sensors  # noqa: PLC0415 - as below

        self.sensors = Sensors(self.world, make_renderer)
        self._stack.append(self.sensors.close)

    def make_node(self, context: Any, node: Any = None) -> WorldNode:
        """Returns the world's ROS node; `node` takes the place of one of rclpy."""
        from executor.ros.node import WorldNode  # noqa: PLC0415 - ROS reads the environment when loaded

        return WorldNode.of_universe(self.world, context, clock_hz=self._tick_hz, node=node)

    def _say_mismatch(self, found: TopicMismatch) -> None:
        if not found.resolved:
            self._say(mismatch_line(found.topic, found.message, found.hint, self._project.files))

    def _make_tree(self, project: Project) -> Tree:
        from executor.application.host import enter, prepare  # noqa: PLC0415 - after the environment
        from executor.application.locate import Locator  # noqa: PLC0415
        from executor.application.randomness import seed_randomness  # noqa: PLC0415
        from translator import self_contained  # noqa: PLC0415
        from translator.package.app import files_beside_engine  # noqa: PLC0415
        from tree_gardener import Tree  # noqa: PLC0415

        app = project.files.get(TREE_FILE)
        text = app.decode("utf-8") if app is not None else self_contained(project)
        folder = Scratch()
        self._stack.append(folder.remove)
        write_files(folder.path, files_beside_engine(project))
        prepare()
        self._stack.append(enter(folder.path))
        options = self._options
        self._randomness = seed_randomness(
            options.seed if options.actions_seed is None else options.actions_seed
        )
        self._locator = Locator()
        self._record_output()
        with recorded(*self._output):
            tree = Tree.from_xml(text, clock=WorldClock(self.world))
            tree.on_warning = lambda node, message: self._say(f"{node.path}: {message}")
            self._locator.learn(tree)
            tree.setup(node=self._ros.application)
        self._stack.append(tree.shutdown)
        if options.groot2:
            from tree_gardener.groot import Groot2Publisher  # noqa: PLC0415 - needed only with a port

            self._stack.append(Groot2Publisher(tree, options.groot2, waiting=self.waiting).close)
        self.counts = tree.count_results()
        return tree

    def _open_recording(self, project: Project) -> Recording | None:
        options = self._options
        if options.recording is None:
            return None
        from executor.headless.recording import open_recording  # noqa: PLC0415 - few runs are recorded

        universe, robot, seed = options.universe, options.robot, options.seed
        recording = open_recording(options.recording, project, universe=universe, robot=robot, seed=seed)
        self._stack.append(recording.close)
        return recording

    def _make_recorder(self, recording: Recording | None) -> RunRecorder | None:
        if recording is None:
            return None
        from executor.headless.recorder import RunRecorder  # noqa: PLC0415 - few runs are recorded

        recorder = RunRecorder(recording, self.world, self.sensors, self.node, self.tree)
        for line in self._printed:
            recorder.printed(line)
        recorder.look()
        return recorder

    def _record_output(self) -> None:
        """Prepares the streams that also write the output of users' code into the recording."""
        if self._options.recording is None:
            return

        def print_(line: Log) -> None:
            if self._recorder is None:
                self._printed.append(line)
            else:
                self._recorder.printed(line)

        make = partial(RecordedOutput, send=print_, locator=self._locator, now_s=lambda: self.world.time_s)
        self._output = make("info", original=sys.stdout), make("error", original=sys.stderr)

    def _advance(self, until_step: int) -> None:
        """Steps the world up to a step; its sensors measure at their rates meanwhile, as in real time."""
        if self._stepper.done == 0:
            self._stepper.publish()
        while self._stepper.done < until_step:
            self._stepper.advance(until_step)

    def _tell_moved(self) -> None:
        self.moved()  # may be set later

    def _record_published(self) -> None:
        if self._recorder is not None:
            self._recorder.look()

    def _let_time_pass(self) -> None:
        """Simulates for a short time while an action waits in rclpy, as real time would pass."""
        if self.world.time_s >= self._options.duration_s:
            raise TimeoutError(TOO_LONG)
        self._advance(self._stepper.done + PERIOD_STEPS)
        self.node.poll()

    def _call_back(self, runner: Runner) -> None:
        """Runs the callbacks of the actions; an exception of one may end the run."""
        with recorded(*self._output):
            try:
                self._ros.executor.drain()
            except (Exception, SystemExit) as error:
                runner.fail(error)

    def _tick(self, runner: Runner) -> Status | None:
        began_s = time.perf_counter()
        with recorded(*self._output):
            status: Status | None = runner.tick_now()
        self._durations.append(time.perf_counter() - began_s)
        if self._profile is not None:
            self._profile.look(self.world.time_s)
        return status

    def _note_fault(self, error: TickError) -> None:
        if self._recorder is not None:
            self._recorder.raised(error)
        self.report.errors.append(
            {
                "node_path": error.path,
                "node_id": error.node_id,
                "file": error.file,
                "line": error.line,
                "message": error.message,
                "traceback": error.traceback_text,
                "t": self.world.time_s,
            }
        )

    def _note_end(self, status: Status | None, last: Status) -> None:
        """Stores the result of the tree, once."""
        if self.has_ended:
            return
        self.has_ended = True
        self.report.root_status = (status or last).name
        if self._recorder is not None:
            self._recorder.finished(status)

    def sample(self, tick: int) -> None:
        """Adds the pose of the first robot, and the nearest range of its scan, to the report."""
        every = max(1, round(self._tick_hz / TRAJECTORY_HZ))
        if tick % every or not self.world.robots:
            return
        robot = self.world.robots[0]
        x, y, yaw = robot.pose
        self.report.trajectory.append([round(v, 6) for v in (self.world.time_s, x, y, yaw)])
        for lidar in robot.config.lidars[:1]:
            nearest = float(self.sensors.scan(robot, lidar).ranges.min())
            best = self.report.min_range_m
            if math.isfinite(nearest) and (best is None or nearest < best):
                self.report.min_range_m = round(nearest, 6)

    def _finish(self, began_s: float, overruns: int) -> Report:
        report = self.report
        report.wall_time_s = time.perf_counter() - began_s
        report.sim_time_s = self.world.time_s
        report.real_time_factor = report.sim_time_s / max(report.wall_time_s, 1e-9)
        report.ticks = self.tree.tick_number
        report.tick_ms, report.overruns = quantiles(self._durations), overruns
        report.nodes = [
            NodeCount(node.path, count.ticks, count.success, count.failure, count.running)
            for node, count in zip(self.tree.nodes, self.counts, strict=True)
        ]
        report.random = self.world.has_drawn or not self._randomness.is_untouched
        if self.world.robots:
            robot = self.world.robots[0]
            report.distance_m = round(robot.distance_m, 6)
            report.collisions, report.hits = robot.collisions, robot.hits
        return report


def _open(project: Project | Mapping[str, bytes] | Path) -> Project:
    from translator import Project, open_files, open_path  # noqa: PLC0415 - slow to load

    if isinstance(project, Project):
        return project
    if isinstance(project, Mapping):
        return open_files(project)
    return open_path(project)


def _write_assets(project: Project, folder: Path) -> None:
    """Writes the project's robots and assets into the folder that the world reads."""
    write_files(folder, {k: v for k, v in project.files.items() if k.startswith(("assets/", "robots/"))})


def _say(line: str) -> None:
    sys.stderr.write(f"{line}\n")
