"""Errors of sessions; the tree of exceptions starts at `backend.core.problems.StudioError`."""

from __future__ import annotations

from backend.core.problems import StudioError


class LaunchError(StudioError):
    """An executor could not be started."""

    status = 503
    code = "session_failed"
    title = "The session did not start"


class DrainingError(StudioError):
    """No robot starts, since the server will be upgraded."""

    status = 503
    code = "draining"
    title = "No robot starts now"


class AddressError(StudioError):
    """An address is not of a program that can be followed."""

    status = 400
    code = "bad_address"
    title = "This is no address of a program"


class AttachingLocalError(StudioError):
    """This server does not follow programs."""

    status = 403
    code = "attaching_is_local"
    title = "This server cannot be attached to a robot"


class OwnPlacesTakenError(StudioError):
    """So many robots of the user wait that one more may not."""

    status = 409
    code = "own_places_taken"
    title = "Too many of your robots wait"


class HostFullError(StudioError):
    """Every ROS domain of this host is in use."""

    status = 503
    code = "host_full"
    title = "Too many sessions"
