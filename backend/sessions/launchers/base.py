"""The interface between sessions and the launchers that run their executors.

A launcher starts one executor manager for a session, reports whether it runs, and ends it. It stores nothing:
the *state* that `start` returns holds everything that is needed to find the executor again. The state is a
JSON object that the caller stores and passes to the other methods, also after a restart of the web server.

    start(spec)      blocks until the manager listens; returns where, and the state. On failure it
                     raises LaunchError, and leaves nothing running.
    poll(state)      None while the executor runs; else its exit status, or UNKNOWN_EXIT when it is
                     gone and its status is not known. Never blocks.
    stop(state)      ends the executor and all that it started, first by a signal that it can handle.
                     Returns when nothing is left; it is no error if the executor has ended.
    explain(state)   why an executor ended, if more is known than its status; else "".
    open_tools(id, token)  the address at which a user's tools listen (`executor.tools`); starts them.
                     Raises LaunchError if the launcher has no containers.
    keeps_warm       whether executors can be started ahead of their sessions (`sessions.warm`). If so:
    warm(spec)       as `start`, for an executor that waits; the id of `spec` is its own.
    warm_running()   the states of all that run, by their ids, also of those that were claimed.
    warm_state_of(id)  the state of one of which only the id is known.
    prepare(spec)    starts an executor for the next session with a target, which is likely to come; one waits
                     at most, and for minutes only. A launcher may leave it.
    tidy()           removes tools that have ended; called every minute by one web server.
    recordings       the folder in which recordings are left, one folder a session; None if they end with it.
    shares_network   whether executors share one network, so that each needs a ROS domain of its own.
    starts_at_once   how many executors may be starting at a time; each start takes a thread that waits.
    survives_server  whether executors outlive the web server. If they do, two more methods are required:
    running()        the ids of all sessions whose executors run, known to the database or not.
    state_of(id)     the state of a session of which only the id is known.

A class that lacks one of them, or leaves `name` empty, fails when it is defined.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Final

from backend.sessions.errors import LaunchError

if TYPE_CHECKING:
    from pathlib import Path

State = Mapping[str, Any]
UNKNOWN_EXIT: Final = -1
OWN_NETWORK_DOMAIN: Final = 1
"""The ROS domain of every executor that has a network of its own."""
WARM: Final = "warm"
"""The key in a launcher's state of the id of an executor that was started before its session."""
_METHODS: Final = ("start", "poll", "stop")
_SURVIVORS_OWE: Final = ("running", "state_of")
_WARM_OWE: Final = ("warm", "warm_running", "warm_state_of")


@dataclass(frozen=True, slots=True)
class Spec:
    """The parameters for the start of an executor."""

    session_id: str
    token: str = field(repr=False)
    ros_domain_id: int
    start_timeout_s: float
    stop_timeout_s: float
    target: str = ""
    """HOST:PORT of the program that an attached session follows."""
    own_cluster: bool = False
    """Whether it is an evaluation that has a Ray cluster of its own."""


@dataclass(frozen=True, slots=True)
class Started:
    """A manager that listens at `address` (host:port), and the state by which it is found again."""

    address: str
    state: dict[str, Any]


class Launcher:
    """The interface of launchers; the module's docstring describes each method."""

    name: ClassVar[str] = ""
    shares_network: ClassVar[bool] = False
    starts_at_once: ClassVar[int] = 4
    survives_server: ClassVar[bool] = False
    keeps_warm: ClassVar[bool] = False
    recordings: Path | None = None

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        owed = _METHODS + (_SURVIVORS_OWE if cls.survives_server else ())
        owed += _WARM_OWE if cls.keeps_warm else ()
        missing = [method for method in owed if getattr(cls, method) is getattr(Launcher, method)]
        if missing or not cls.name:
            lacking = ", ".join(missing or ["name"])
            raise TypeError(f"The launcher {cls.__name__} does not define {lacking}.")

    # `__init_subclass__` refuses a launcher that does not define the next three.

    def start(self, spec: Spec) -> Started:
        """Starts an executor, and waits until its manager listens."""
        raise NotImplementedError

    def poll(self, state: State) -> int | None:
        """Returns None while the executor runs, afterwards its exit status."""
        raise NotImplementedError

    def stop(self, state: State, *, timeout_s: float) -> None:
        """Ends the executor and everything that it started."""
        raise NotImplementedError

    def explain(self, state: State) -> str:
        """Returns the reason why an executor ended; "" if it is not known."""
        return ""

    def open_tools(self, tools_id: str, token: str, *, timeout_s: float) -> str:
        """Starts a user's tools, and returns the address at which they listen."""
        raise LaunchError("Without containers there are none for users' files.")

    # `__init_subclass__` refuses a launcher with `keeps_warm` that does not define this.

    def warm(self, spec: Spec) -> Started:
        """Starts an executor that waits for its session."""
        raise NotImplementedError

    def warm_running(self) -> dict[str, dict[str, Any]]:
        """Returns the states of the executors that were started warm, by their ids."""
        return {}

    def warm_state_of(self, made_id: str) -> dict[str, Any]:
        """Returns the state of a warm executor by its id."""
        return {}

    def prepare(self, spec: Spec) -> None:
        """Starts an executor for the next session with a target; the id of `spec` is its own."""

    def tidy(self) -> None:
        """Removes tools that have ended by themselves."""

    def running(self) -> list[str]:
        """Returns the ids of the sessions whose executors run."""
        return []

    def state_of(self, session_id: str) -> dict[str, Any]:
        """Returns the state of a session by its id."""
        return {}
