"""Makes and deletes objects of a cluster, and says why one is refused."""

from __future__ import annotations

import logging
import math
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any, Final, TypeVar

import httpx2
from lightkube import ApiError

from backend.sessions.errors import HostFullError, LaunchError

if TYPE_CHECKING:
    from lightkube import Client

__all__ = ["NOT_FOUND", "QUOTA", "TakenError", "create", "delete", "refused"]

log = logging.getLogger(__name__)

FORBIDDEN: Final = 403
NOT_FOUND: Final = 404
CONFLICT: Final = 409
TOO_MANY: Final = 429
QUOTA: Final = "exceeded quota"
_SHORTEST_PAUSE_S: Final = 0.5
Made = TypeVar("Made")


class TakenError(HostFullError):
    """An object of this name exists."""


def create(client: Client, body: Made, deadline_s: float, *, is_owned: bool = False) -> Made:
    """Makes an object; asks again while the cluster has too many requests.

    Args:
        client: the client of its namespace.
        body: the object.
        deadline_s: the time of `time.monotonic` up to which it asks again.
        is_owned: whether it goes with another object, which the caller deletes.

    Raises:
        HostFullError: the quota of the namespace is used up, or the last one of this name has not gone yet.
        LaunchError: the cluster refuses the object, or does not answer.
    """
    made: Any = body
    while True:
        try:
            return client.create(made)  # type: ignore[no-any-return]
        except ApiError as error:
            if error.status.code != TOO_MANY or monotonic() >= deadline_s:
                raise refused(error) from error
            sleep(_pause_s(error))
        except (httpx2.HTTPError, OSError) as error:
            if not is_owned:  # it may have been made all the same
                delete(client, type(made), made.metadata.name, 0.0)
            raise LaunchError(f"The cluster does not answer: {error}.") from error


def delete(client: Client, resource: type[Any], name: str, grace_s: float) -> bool:
    """Asks for the end of an object; returns False if there is none."""
    what = resource.__name__
    try:
        client.delete(resource, name, grace_period=math.ceil(grace_s))
    except ApiError as error:
        if error.status.code == NOT_FOUND:
            return False
        log.warning("the %s %s is not deleted: %s", what, name, error.status.message)
    except (httpx2.HTTPError, OSError) as error:
        log.warning("the %s %s is not deleted: %s", what, name, error)
    return True


def refused(error: ApiError) -> LaunchError | HostFullError:
    """Returns what a user reads of a refusal."""
    text = error.status.message or str(error)
    if error.status.code == FORBIDDEN and QUOTA in text:
        return HostFullError(f"The sessions of this server have used up their part of the cluster. ({text})")
    if error.status.code == CONFLICT:
        return TakenError("The last start of this session has not ended yet.")
    return LaunchError(f"The cluster refused the session: {text}", hint="Ask who runs this server.")


def _pause_s(error: ApiError) -> float:
    """Returns how long the cluster asks to wait, in s."""
    asked = error.response.headers.get("Retry-After", "") if error.response is not None else ""
    return max(_SHORTEST_PAUSE_S, float(asked) if asked.isdecimal() else 0.0)
