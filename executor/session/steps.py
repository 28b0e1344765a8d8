"""Steps: the commands that take time, as generators.

A step yields a `Wait` and is resumed with its result; `StepFailed` is raised in the generator when the wait
can no longer succeed or times out, or when the step is cancelled. A step that fails leaves the ladder on the
last rung that it reached.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeVar

from msgspec import structs

from executor import child_messages, messages
from executor.apply_messages import Apply, RunOn
from executor.child_messages import ApplicationReady, Failed, Fault, StartWorld, WorldReady
from executor.session import streaming
from executor.session.exact.going_back import go_back, tick_back
from executor.session.exact.hosting import choose, expect, host, state_of_world
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.live.going_back import go_back_live
from executor.session.running import (
    begun,
    go,
    hold_world,
    pause,
    resume,
    set_blackboard,
    step,
    terminate_application,
)
from executor.session.waits import (
    Answered,
    Step,
    StepFailed,
    Wait,
    confirmed,
    is_spare_lost,
    taken,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from msgspec import Struct

    from executor.session.child import Child
    from executor.session.debugger.attaching import Attaching
    from executor.session.events import Unpacked
    from executor.session.stage import Stage

__all__ = ["RESET_TIMEOUT_S", "STEPS", "attach", "restart_application"]

Data = TypeVar("Data", bound="Struct")

LAUNCH_TIMEOUT_S: Final = 60.0
LOAD_TIMEOUT_S: Final = 60.0
UNPACK_TIMEOUT_S: Final = 30.0
WORLD_GRACE_S: Final = 2.0
EXIT_TIMEOUT_S: Final = 10.0
RESET_TIMEOUT_S: Final = 60.0


def _progress(stage: Stage, rung: messages.Rung, fraction: float, message: str) -> None:
    stage.output.emit(messages.Progress(rung, fraction, message))


def _connect(stage: Stage, _: Struct) -> Step:
    stage.enter(State.CONNECTED)
    stage.children.replenish()
    yield from ()


def _launch_universe(stage: Stage, data: messages.LaunchUniverse) -> Step:
    expect(stage, data)
    start = yield from _described(stage, data)
    yield from _launch(stage, start)


def _described(stage: Stage, data: messages.LaunchUniverse) -> Answered[StartWorld]:
    """Returns the description of the world that is wanted, of which its assets are unpacked."""
    stage.run.universe = data
    stage.mirror.speed = data.speed
    _aim(stage, data)
    universe, assets, file = data.universe, "", ""
    if isinstance(universe, messages.UniverseDocument):
        if universe.assets_zip_base64:
            unpacked = yield _unpacking(stage, universe.assets_zip_base64)
            assets = _folder_of(unpacked, "assets")
        file = universe.file
        universe = universe.document
    stage.run.world = StartWorld(
        universe=universe,
        file=file,
        assets=assets,
        robot=data.robot,
        seed=data.seed,
        speed=data.speed,
        domain_id=_domain_of(stage, data),
    )
    return stage.run.world


def _launch(stage: Stage, start: StartWorld) -> Step:
    """Starts a world, and waits until it is ready."""
    _progress(stage, "launch_universe", 0.0, "Starting the simulated world")
    try:
        reply = yield from _start_world(stage, start)
    except StepFailed:
        stage.run.universe = None
        stage.children.drop("world")
        stage.children.replenish()
        raise
    stage.run.is_world_alone = False
    stage.mirror.universe = reply.universe or str(start.universe)
    streaming.resume_echoes(stage)
    _progress(stage, "launch_universe", 1.0, "The world is ready")
    stage.enter(State.UNIVERSE_READY)


def _start_world(stage: Stage, start: StartWorld, tries: int = 2) -> Answered[WorldReady]:
    """Starts the universe in the spare world; replaces a spare that is dead, once."""
    world = stage.children.ensure("world")
    world.is_started = True
    stage.children.tell_world(start)
    late = "The world did not become ready in time."
    try:
        reply = yield Wait(taken(world, WorldReady, Failed), LAUNCH_TIMEOUT_S, late)
    except StepFailed as failure:
        if tries == 1 or not is_spare_lost(world, failure):
            raise
        if stage.children.get("world") is world:
            stage.children.drop("world")
        return (yield from _start_world(stage, start, tries - 1))
    if isinstance(reply, Failed):
        raise StepFailed(reply.code or "launch_failed", reply.message, reply.hint)
    assert isinstance(reply, WorldReady)  # noqa: S101 - it waits for these two
    return reply


def _prepare_visualization(stage: Stage, _: Struct) -> Step:
    streaming.open_all(stage)
    _progress(stage, "prepare_visualization", 1.0, "The streams are open")
    stage.enter(State.VISUALIZATION_READY)
    yield from ()


def _unpacking(stage: Stage, archive_base64: str) -> Wait:
    return Wait(stage.unpack(archive_base64), UNPACK_TIMEOUT_S, "The archive took too long to unpack.")


def _folder_of(unpacked: Unpacked, what: str) -> str:
    if unpacked.error:
        raise StepFailed("bad_archive", f"The {what} archive is refused: {unpacked.error}.")
    return unpacked.folder


def _take_folder(stage: Stage, unpacked: Unpacked) -> None:
    stage.run.folder = _folder_of(unpacked, "application's")
    stage.run.plan = unpacked.plan
    if unpacked.problem is not None:
        file, problem = unpacked.problem
        stage.output.emit(
            messages.Fault("load", problem.message, hint=problem.hint, file=file, line=problem.line)
        )
        text = f"{file}:{problem.line}:{problem.column}: {problem.message}."
        raise StepFailed("bad_launch_file", text, problem.hint)


def _run_application(stage: Stage, data: messages.RunApplication) -> Step:
    if stage.state in HAS_APPLICATION:
        yield from terminate_application(stage, data)
    unpacked = yield _unpacking(stage, data.app_zip_base64)
    _take_folder(stage, unpacked)
    stage.run.application = data
    choose(stage)
    yield from _start(stage)


def _start(stage: Stage) -> Step:
    """Starts the application in the world as it is."""
    state = b""
    if stage.children.wants_exact:
        state = (yield from state_of_world(stage)).data
    yield from _await_application(stage, _start_application(stage, state), state=state)


def _apply(stage: Stage, data: Apply) -> Step:
    """Replaces the running tree; a later restart runs the new one too."""
    unpacked = yield _unpacking(stage, data.app_zip_base64)
    folder = _folder_of(unpacked, "application's")
    message = child_messages.ApplyApplication(app_dir=folder, dry=data.dry)
    if not data.dry:
        stage.recording.change_files(folder)
    order = stage.children.order("application", message)
    try:
        yield confirmed(order, "load the changed tree", LOAD_TIMEOUT_S)
    except StepFailed:
        if not data.dry:
            stage.recording.change_files(stage.run.folder)
        raise
    if data.dry or stage.run.application is None:
        return
    stage.past.changed(stage.sim_time_s, folder)
    stage.run.folder, stage.run.plan = folder, unpacked.plan
    stage.run.application = structs.replace(stage.run.application, app_zip_base64=data.app_zip_base64)


def _go_back(stage: Stage, data: messages.GoBack) -> Step:
    """Takes a run back: an exact one is made again, the world of a live one goes back to a keyframe."""
    past = stage.past.find(data.run)
    if past is not None and not past.is_exact:
        return go_back_live(stage, past, data.t)
    return go_back(stage, data)


def _run_on(stage: Stage, data: RunOn) -> Step:
    """Resumes, with a changed tree if there is one; where that is refused, all stays as it is."""
    if data.app_zip_base64:
        yield from _apply(stage, Apply(data.app_zip_base64))
    yield from resume(stage, data)


def restart_application(stage: Stage, data: Struct) -> Step:
    """Restarts the application of the last run."""
    if stage.run.application is None:
        raise StepFailed("nothing_to_restart", "No application was run yet.", "Press Run.")
    if stage.state in HAS_APPLICATION:
        yield from terminate_application(stage, data)
    yield from _start(stage)


def _start_application(stage: Stage, state: bytes = b"") -> Child:
    data = stage.run.application
    assert data is not None  # noqa: S101 - both callers set it
    hold_world(stage)
    stage.mirror.begin_run(data.tick_hz)
    _progress(stage, "run_application", 0.0, "Loading the tree and its actions")
    application = stage.children.ensure("application")
    application.is_started = True
    launched = stage.run.world if application.is_exact else None
    stage.hold.since_s, stage.hold.given = None, stage.hold.breakpoints
    stage.hold.profile_given = stage.hold.profile
    stage.hold.groot2_given = stage.hold.groot2
    start = child_messages.StartApplication(
        app_dir=stage.run.folder,
        tick_hz=data.tick_hz,
        on_finish=data.on_finish,
        on_error=data.on_error,
        seed=stage.run.seed,
        domain_id=stage.run.domain_id,
        outside=stage.run.is_outside,
        breakpoints=stage.hold.breakpoints,
        profile=stage.hold.profile,
        groot2=stage.hold.groot2,
        is_debugged=stage.python.is_wanted,
        attach=stage.attaching.address if stage.attaching is not None else "",
        world=structs.replace(launched, speed=stage.mirror.speed) if launched is not None else None,
        world_state=state,
    )
    stage.children.tell_application(start)
    if application.is_exact or not (stage.run.is_outside or stage.attaching is not None):
        stage.past.begin(start)
    if stage.attaching is not None and stage.attaching.controls:
        stage.children.tell_application(child_messages.Control(on=True))
    stage.nodes.start(stage, stage.run.plan)
    return application


def _await_application(stage: Stage, application: Child, tries: int = 2, state: bytes = b"") -> Step:
    """Waits until the application is loaded, then resumes time; replaces a spare that is dead, once.

    `state` is that of the world, with which an exact run was started.
    """
    try:
        reply = yield Wait(
            taken(application, Fault, ApplicationReady),
            LOAD_TIMEOUT_S,
            "The application did not finish loading in time: a module or a setup() hangs.",
        )
        if isinstance(reply, Fault):
            raise StepFailed("load_failed", reply.message, reply.hint)
        _progress(stage, "run_application", 1.0, "The application runs")
        host(stage, application)
        stage.recording.begin()
        if stage.attaching is None and not stage.run.is_outside:
            stage.past.name(stage.recording.run)
        yield from go(stage, application)
    except StepFailed as failure:
        stage.past.drop_unborn()
        if stage.children.get("application") is application:
            stage.children.drop("application")
        has_world = stage.state.reaches(State.VISUALIZATION_READY)
        if tries > 1 and has_world and is_spare_lost(application, failure):
            yield from _await_application(stage, _start_application(stage, state), tries - 1, state)
            return
        stage.children.replenish()
        raise
    begun(stage, application)


def _run(stage: Stage, data: messages.Run) -> Step:
    """Climbs all rungs; world and application load in parallel."""
    if stage.state in HAS_APPLICATION:
        yield from terminate_application(stage, data)
    if stage.state is State.IDLE:
        yield from _connect(stage, data)
    expect(stage, data.universe)
    hold_world(stage)
    orders = []
    if stage.state.reaches(State.UNIVERSE_READY):
        if stage.children.ensure("world").is_hanging or not _is_same_world(stage.run.universe, data.universe):
            yield from _end_world(stage)
        else:
            orders = _reuse_world(stage, data.universe.speed)
    unpacking = _unpacking(stage, data.application.app_zip_base64)
    unpacked = yield unpacking
    _take_folder(stage, unpacked)
    stage.run.application = data.application
    _aim(stage, data.universe)
    choose(stage)
    is_there = stage.state.reaches(State.UNIVERSE_READY)
    start = None if is_there else (yield from _described(stage, data.universe))
    application = _start_application(stage)  # an exact run builds the same world, from its beginning
    try:
        for order in orders:
            yield confirmed(order, "reset", RESET_TIMEOUT_S)
        if start is not None:
            yield from _launch(stage, start)
    except StepFailed:
        stage.children.drop("application")
        stage.children.replenish()
        raise
    if not stage.state.reaches(State.VISUALIZATION_READY):
        yield from _prepare_visualization(stage, data)
    yield from _await_application(stage, application)


def attach(stage: Stage, attaching: Attaching) -> Step:
    """Follows another program's tree: the session has a child for it in place of an application."""
    stage.attaching = attaching
    stage.run.folder = attaching.folder
    stage.run.application = messages.RunApplication("")
    yield from _connect(stage, messages.Empty())
    yield from _launch_universe(stage, messages.LaunchUniverse("none"))
    yield from _prepare_visualization(stage, messages.Empty())
    yield from _await_application(stage, _start_application(stage))


def _reuse_world(stage: Stage, speed: float) -> list[tuple[Child, str]]:
    """Resets a running world for a new run; returns the requests that it still has to answer."""
    orders = [stage.children.order("world", child_messages.Reset())]
    if not stage.run.is_outside:
        orders.append(stage.children.order("world", child_messages.SetSpeed(speed)))
        stage.mirror.speed = speed
    return orders


def _aim(stage: Stage, data: messages.LaunchUniverse) -> None:
    """Stores the seed of the actions, and the ROS graph that the application and its launch nodes use."""
    stage.run.seed = data.seed
    stage.run.is_outside = data.universe == "none"
    stage.run.wants_exact = data.time == "exact"
    stage.run.domain_id = _domain_of(stage, data)


def _domain_of(stage: Stage, data: messages.LaunchUniverse) -> int:
    if data.universe != "none":
        return stage.about.ros_domain_id
    return stage.about.outside_domain_id if data.domain_id is None else data.domain_id


def _is_same_world(old: messages.LaunchUniverse | None, new: messages.LaunchUniverse) -> bool:

    def key(launch: messages.LaunchUniverse) -> tuple[object, ...]:
        return launch.universe, launch.robot, launch.seed, launch.domain_id

    return old is not None and key(old) == key(new)


def _terminate_visualization(stage: Stage, _: Struct) -> Step:
    streaming.close_all(stage)
    stage.enter(State.UNIVERSE_READY)
    yield from ()


def _end_world(stage: Stage) -> Step:
    """Descends to `connected`, rung by rung."""
    if stage.state in HAS_APPLICATION:
        yield from terminate_application(stage, messages.Empty())
    if stage.state is State.VISUALIZATION_READY:
        yield from _terminate_visualization(stage, messages.Empty())
    if stage.state is State.UNIVERSE_READY:
        stage.children.drop("world", grace_s=WORLD_GRACE_S)
        stage.run.universe = None
        stage.enter(State.CONNECTED)


def _terminate_universe(stage: Stage, _: Struct) -> Step:
    stage.children.drop("world", grace_s=WORLD_GRACE_S)
    stage.run.universe = None
    stage.enter(State.CONNECTED)
    stage.children.replenish()
    yield from _all_gone(stage)


def _all_gone(stage: Stage) -> Step:
    yield Wait(lambda: None if stage.children.leaving else True, EXIT_TIMEOUT_S, "A process does not end.")


def _disconnect(stage: Stage, _: Struct) -> Step:
    stage.trying.stop()
    stage.sources.stop()
    yield from _end_world(stage)
    stage.children.drop("application")
    stage.children.drop("world")
    yield from _all_gone(stage)
    if stage.state is not State.IDLE:
        stage.enter(State.IDLE)


def _typed(kind: type[Data], step: Callable[[Stage, Data], Step]) -> Callable[[Stage, Struct], Step]:
    """Converts a step for one type of data to a step for any data; `COMMANDS` ensures the type."""

    def begin(stage: Stage, data: Struct) -> Step:
        if not isinstance(data, kind):
            raise TypeError(f"{kind.__name__} expected, not {type(data).__name__}")
        return step(stage, data)

    return begin


STEPS: Final[dict[str, Callable[[Stage, Struct], Step]]] = {
    "connect": _connect,
    "launch_universe": _typed(messages.LaunchUniverse, _launch_universe),
    "prepare_visualization": _prepare_visualization,
    "run_application": _typed(messages.RunApplication, _run_application),
    "run": _typed(messages.Run, _run),
    "apply": _typed(Apply, _apply),
    "run_on": _typed(RunOn, _run_on),
    "go_back": _typed(messages.GoBack, _go_back),
    "tick_back": tick_back,
    "restart_application": restart_application,
    "pause": pause,
    "resume": resume,
    "step": step,
    "set_blackboard": _typed(messages.SetBlackboard, set_blackboard),
    "terminate_application": terminate_application,
    "terminate_visualization": _terminate_visualization,
    "terminate_universe": _terminate_universe,
    "disconnect": _disconnect,
}
