"""Sessions that follow programs outside, by Groot2's protocol."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING
from uuid import uuid4

from backend.config.environment import environment
from backend.sessions import queries
from backend.sessions.choices import SessionKind
from backend.sessions.errors import AttachingLocalError, LaunchError
from backend.sessions.launchers.base import Spec
from backend.sessions.launchers.process import ProcessLauncher
from backend.sessions.lifecycle import drain, writes
from backend.sessions.models import LIVE_STATES
from backend.sessions.targets import read_target

if TYPE_CHECKING:
    from backend.accounts.models import User
    from backend.sessions.models import Session

__all__ = ["attach", "may_attach", "prepare"]

log = logging.getLogger(__name__)


def attach(address: str, *, acting_user: User) -> Session:
    """Starts a session that follows a program, or returns the one in which the user already follows it.

    Raises:
        AddressError: the address is not of a program.
        AttachingLocalError: this server is for a team.
        HostFullError: no place is free.
        DrainingError: the server is about to be upgraded.
    """
    _require_attaching()
    target = read_target(address)
    running = queries.attached_session(target, user=acting_user)
    if running is not None and writes.refresh(running).state in LIVE_STATES:
        return running
    drain.require_open()
    return writes.begin(None, SessionKind.ATTACHED, acting_user, target)


def prepare() -> None:
    """Starts the executor of a session that is likely to follow a program soon, unless there is no room.

    Raises:
        AttachingLocalError: this server is for a team.
    """
    _require_attaching()
    if writes.places_left(LIVE_STATES) > 0:
        writes.workers().submit(_prepare)


def may_attach() -> bool:
    """Returns whether this server follows programs: only one for a single user on their own computer."""
    return not environment().is_team and writes.launcher().name == ProcessLauncher.name


def _require_attaching() -> None:
    if not may_attach():
        raise AttachingLocalError(
            "A server for teams connects to no programs: its users could reach its network that way.",
            hint="Run BT Studio on your own computer, or follow the tree with `bt-studio attach`.",
        )


def _prepare() -> None:
    limits = environment()
    made_id = str(uuid4())
    spec = Spec(
        session_id=made_id,
        token=writes.token_of(made_id),
        ros_domain_id=0,
        start_timeout_s=limits.session_start_timeout_s,
        stop_timeout_s=limits.session_stop_timeout_s,
    )
    try:
        writes.launcher().prepare(spec)
    except LaunchError as error:
        log.warning("no executor was started ahead: %s", error.detail)
