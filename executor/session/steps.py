"""What each command does: steps that take time as generators, the others as plain functions.

A step yields a `Wait` and is resumed with what it waited for; `StepFailed` is raised into it when that
cannot come any more, when it is too late, or when the step is cancelled. A step that fails leaves the
ladder on the last rung that it reached.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final, cast

from executor import messages
from executor.launching.model import LaunchPlan
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.running import (
    await_tick,
    go,
    pause,
    resume,
    set_blackboard,
    step,
    stop_moving,
)
from executor.session.waits import (
    Answered,
    Step,
    StepFailed,
    Wait,
    confirmed,
    gone,
    is_spare_lost,
    taken,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from msgspec import Struct

    from executor.session.child import Child
    from executor.session.events import Unpacked
    from executor.session.protocol import Session

__all__ = ["RESET_TIMEOUT_S", "STEPS", "LastRun", "restart_application", "stop_moving"]

LAUNCH_TIMEOUT_S: Final = 60.0
LOAD_TIMEOUT_S: Final = 60.0
UNPACK_TIMEOUT_S: Final = 30.0
WORLD_GRACE_S: Final = 2.0
EXIT_TIMEOUT_S: Final = 10.0
RESET_TIMEOUT_S: Final = 60.0


@dataclass
class LastRun:
    """What was started last, to start it again."""

    universe: messages.LaunchUniverse | None = None
    application: messages.RunApplication | None = None
    folder: str = ""
    plan: LaunchPlan = field(default_factory=LaunchPlan)
    domain_id: int = 0
    is_outside: bool = False
    seed: int = 0
    deaf_until_s: float = 0.0
    """Until then an application that hears no time is not started again once more."""


# --- helpers --------------------------------------------------------------------------------------


def _progress(session: Session, rung: messages.Rung, fraction: float, message: str) -> None:
    session.emit(messages.Progress(rung, fraction, message))


# --- rungs ----------------------------------------------------------------------------------------


def _connect(session: Session, _: Struct) -> Step:
    session.enter(State.CONNECTED)
    session.replenish()
    yield from ()


def _launch_universe(session: Session, data: Struct) -> Step:
    data = cast("messages.LaunchUniverse", data)
    _progress(session, "launch_universe", 0.0, "Starting the simulated world")
    session.run.universe = data
    _aim(session, data)
    universe, assets, file = data.universe, "", ""
    if isinstance(universe, messages.UniverseDocument):
        if universe.assets_zip_base64:
            unpacked = yield _unpacking(session, universe.assets_zip_base64)
            assets = _folder_of(unpacked, "assets")
        file = universe.file
        universe = universe.document
    start = {
        "universe": universe,
        "file": file,
        "assets": assets,
        "robot": data.robot,
        "seed": data.seed,
        "speed": data.speed,
        "domain_id": _domain_of(session, data),
    }
    try:
        reply = yield from _start_world(session, start)
    except StepFailed:
        session.run.universe = None
        session.drop("world")
        session.replenish()
        raise
    session.mirror.universe = str(reply.get("universe") or data.universe)
    session.mirror.speed = data.speed
    session.resume_echoes()
    _progress(session, "launch_universe", 1.0, "The world is ready")
    session.enter(State.UNIVERSE_READY)


def _start_world(session: Session, start: dict[str, Any], tries: int = 2) -> Answered:
    """Has the world that waits build what is asked for; a spare that was lost is replaced once."""
    world = session.child("world")
    world.is_started = True
    session.tell("world", "start", **start)
    late = "The world did not become ready in time."
    try:
        reply: dict[str, Any] = yield Wait(taken(world, "ready", "error"), LAUNCH_TIMEOUT_S, late)
    except StepFailed as failure:
        if tries == 1 or not is_spare_lost(world, failure):
            raise
        if session.children.get("world") is world:
            session.drop("world")
        return (yield from _start_world(session, start, tries - 1))
    if reply["type"] == "error":
        hint = str(reply.get("hint", ""))
        raise StepFailed(str(reply.get("code") or "launch_failed"), str(reply.get("message", "")), hint)
    return reply


def _prepare_visualization(session: Session, _: Struct) -> Step:
    session.open_streams()
    _progress(session, "prepare_visualization", 1.0, "The streams are open")
    session.enter(State.VISUALIZATION_READY)
    yield from ()


def _unpacking(session: Session, archive_base64: str) -> Wait:
    return Wait(session.unpack(archive_base64), UNPACK_TIMEOUT_S, "The archive took too long to unpack.")


def _folder_of(unpacked: Unpacked, what: str) -> str:
    if unpacked.error:
        raise StepFailed("bad_archive", f"The {what} archive is refused: {unpacked.error}.")
    return unpacked.folder


def _take_folder(session: Session, unpacked: Unpacked) -> None:
    session.run.folder = _folder_of(unpacked, "application's")
    session.run.plan = unpacked.plan
    if unpacked.problem is not None:
        file, problem = unpacked.problem
        session.emit(messages.Fault("load", problem.message, hint=problem.hint, file=file, line=problem.line))
        text = f"{file}:{problem.line}:{problem.column}: {problem.message}."
        raise StepFailed("bad_launch_file", text, problem.hint)


def _run_application(session: Session, data: Struct) -> Step:
    data = cast("messages.RunApplication", data)
    if session.state in HAS_APPLICATION:
        yield from _terminate_application(session, data)
    unpacked = yield _unpacking(session, data.app_zip_base64)
    _take_folder(session, unpacked)
    session.run.application = data
    application = _start_application(session)
    yield from _await_application(session, application)


def restart_application(session: Session, data: Struct) -> Step:
    """Starts the application of the last run again."""
    if session.run.application is None:
        raise StepFailed("nothing_to_restart", "No application was run yet.", "Press Run.")
    if session.state in HAS_APPLICATION:
        yield from _terminate_application(session, data)
    yield from _await_application(session, _start_application(session))


def _start_application(session: Session) -> Child:
    data = session.run.application
    assert data is not None  # noqa: S101 - both callers set it
    session.mirror.begin_run(data.tick_hz)
    _progress(session, "run_application", 0.0, "Loading the tree and its actions")
    application = session.child("application")
    application.is_started = True
    session.tell(
        "application",
        "start",
        app_dir=session.run.folder,
        tick_hz=data.tick_hz,
        on_finish=data.on_finish,
        on_error=data.on_error,
        seed=session.run.seed,
        domain_id=session.run.domain_id,
        outside=session.run.is_outside,
    )
    session.nodes.start(session, session.run.plan)
    return application


def _await_application(session: Session, application: Child, tries: int = 2) -> Step:
    """Waits until it has loaded, and lets time pass; a spare that was lost is replaced once."""
    try:
        reply = yield Wait(
            taken(application, "fault", "ready"),
            LOAD_TIMEOUT_S,
            "The application did not finish loading in time: a module or a setup() hangs.",
        )
        if reply["type"] == "fault":
            raise StepFailed("load_failed", str(reply.get("message")), str(reply.get("hint", "")))
        _progress(session, "run_application", 1.0, "The application runs")
        yield from go(session, application)
    except StepFailed as failure:
        if session.children.get("application") is application:
            session.drop("application")
        has_world = session.state.reaches(State.VISUALIZATION_READY)
        if tries > 1 and has_world and is_spare_lost(application, failure):
            yield from _await_application(session, _start_application(session), tries - 1)
            return
        session.replenish()
        raise
    session.enter(State.APPLICATION_RUNNING)


def _run(session: Session, data: Struct) -> Step:
    """Climbs all rungs; the application loads while the world starts."""
    data = cast("messages.Run", data)
    if session.state in HAS_APPLICATION:
        yield from _terminate_application(session, data)
    if session.state is State.IDLE:
        yield from _connect(session, data)
    orders = []
    if session.state.reaches(State.UNIVERSE_READY):
        if session.child("world").is_hanging or not _is_same_world(session.run.universe, data.universe):
            yield from _end_world(session)
        else:
            orders = _reuse_world(session, data.universe.speed)
    unpacking = _unpacking(session, data.application.app_zip_base64)
    unpacked = yield unpacking
    _take_folder(session, unpacked)
    session.run.application = data.application
    _aim(session, data.universe)
    application = _start_application(session)
    try:
        for order in orders:
            yield confirmed(order, "reset", RESET_TIMEOUT_S)
        if not session.state.reaches(State.UNIVERSE_READY):
            yield from _launch_universe(session, data.universe)
    except StepFailed:
        session.drop("application")
        session.replenish()
        raise
    if not session.state.reaches(State.VISUALIZATION_READY):
        yield from _prepare_visualization(session, data)
    yield from _await_application(session, application)


def _reuse_world(session: Session, speed: float) -> list[tuple[Child, str]]:
    """Has a world that is up begin again; returns what it has to confirm."""
    orders = [session.order("world", "reset")]
    if not session.run.is_outside:
        orders.append(session.order("world", "set_speed", speed=speed))
        session.mirror.speed = speed
    return orders


def _aim(session: Session, data: messages.LaunchUniverse) -> None:
    """Notes the seed of the actions, and into which ROS graph the application and its extra nodes go."""
    session.run.seed = data.seed
    session.run.is_outside = data.universe == "none"
    session.run.domain_id = _domain_of(session, data)


def _domain_of(session: Session, data: messages.LaunchUniverse) -> int:
    if data.universe != "none":
        return session.about.ros_domain_id
    return session.about.outside_domain_id if data.domain_id is None else data.domain_id


def _is_same_world(old: messages.LaunchUniverse | None, new: messages.LaunchUniverse) -> bool:

    def key(launch: messages.LaunchUniverse) -> tuple[object, ...]:
        return launch.universe, launch.robot, launch.seed, launch.domain_id

    return old is not None and key(old) == key(new)


# --- down the ladder ------------------------------------------------------------------------------


def _terminate_application(session: Session, _: Struct) -> Step:
    if session.state not in HAS_APPLICATION:
        return
    application = session.child("application")
    application.is_stopping = True
    session.tell("application", "stop")
    stop_moving(session)
    yield from await_tick(session, application, gone(application))


def _terminate_visualization(session: Session, _: Struct) -> Step:
    session.close_streams()
    session.enter(State.UNIVERSE_READY)
    yield from ()


def _end_world(session: Session) -> Step:
    """Leaves the rungs above `connected`, one by one."""
    if session.state in HAS_APPLICATION:
        yield from _terminate_application(session, messages.Empty())
    if session.state is State.VISUALIZATION_READY:
        yield from _terminate_visualization(session, messages.Empty())
    if session.state is State.UNIVERSE_READY:
        session.drop("world", grace_s=WORLD_GRACE_S)
        session.run.universe = None
        session.enter(State.CONNECTED)


def _terminate_universe(session: Session, _: Struct) -> Step:
    session.drop("world", grace_s=WORLD_GRACE_S)
    session.run.universe = None
    session.enter(State.CONNECTED)
    session.replenish()
    yield from _all_gone(session)


def _all_gone(session: Session) -> Step:
    yield Wait(lambda: None if session.leaving else True, EXIT_TIMEOUT_S, "A process does not end.")


def _disconnect(session: Session, _: Struct) -> Step:
    yield from _end_world(session)
    session.drop("application")
    session.drop("world")
    yield from _all_gone(session)
    if session.state is not State.IDLE:
        session.enter(State.IDLE)


STEPS: Final[dict[str, Callable[[Session, Struct], Step]]] = {
    "connect": _connect,
    "launch_universe": _launch_universe,
    "prepare_visualization": _prepare_visualization,
    "run_application": _run_application,
    "run": _run,
    "restart_application": restart_application,
    "pause": pause,
    "resume": resume,
    "step": step,
    "set_blackboard": set_blackboard,
    "terminate_application": _terminate_application,
    "terminate_visualization": _terminate_visualization,
    "terminate_universe": _terminate_universe,
    "disconnect": _disconnect,
}
