"""Errors of the object store, each with what failed, where, and what to do."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

from backend.core.problems import StudioError

if TYPE_CHECKING:
    from collections.abc import Iterator

_SETTINGS: Final = "BT_STUDIO_OBJECT_STORE_KEY and BT_STUDIO_OBJECT_STORE_SECRET"
_LATER: Final = "Try again in a moment. If it stays so, an administrator can run `admin storage check`."
_KNOWN: Final[dict[str, tuple[str, str]]] = {
    "NoSuchBucket": ("there is no such bucket", "Make the bucket, or correct BT_STUDIO_OBJECT_STORE."),
    "InvalidAccessKeyId": ("the access key is unknown there", f"Correct {_SETTINGS}."),
    "SignatureDoesNotMatch": ("the secret does not fit the access key", f"Correct {_SETTINGS}."),
    "AccessDenied": (
        "access is denied",
        "Let the key read, write, delete and list this bucket, and correct the key if it is of another one.",
    ),
    "403": ("access is denied", f"Correct {_SETTINGS}, or let the key read, write, delete and list."),
    "404": ("there is no such bucket", "Make the bucket, or correct BT_STUDIO_OBJECT_STORE."),
}
_ABSENT: Final = frozenset({"NoSuchKey", "404"})


class StoreError(StudioError):
    """The object store cannot be used now."""

    status = 503
    code = "object_store_unavailable"
    title = "The store of large files does not answer"
    retry_after_s = 5


class ObjectMissingError(StoreError):
    """The store has no object of this name."""

    code = "object_missing"
    title = "A stored file is missing"
    retry_after_s = 0


def not_configured() -> StoreError:
    """Returns the error for an object that is asked for where no store is set."""
    return StoreError(
        "The content is in an object store, and this server has none.",
        hint="Set BT_STUDIO_OBJECT_STORE as it was, then restart the web servers.",
    )


def damaged(key: str, place: str) -> StoreError:
    """Returns the error for an object whose bytes are not those that were stored."""
    return StoreError(
        f"The object {key} in {place} is not what was stored: its size or SHA-256 differs.",
        hint="Bring it back from a backup of the bucket.",
    )


@contextmanager
def explained(place: str, key: str = "") -> Iterator[None]:
    """Turns errors of the library into errors of this module.

    Args:
        place: the bucket and its server, for the sentence.
        key: the object that is asked for; without one, an absent object is an absent bucket.
    """
    from botocore.exceptions import (  # noqa: PLC0415 - slow to load
        BotoCoreError,
        ClientError,
        HTTPClientError,
        NoCredentialsError,
    )

    try:
        yield
    except ClientError as error:
        raise _refused(error.response, place, key) from error
    except NoCredentialsError as error:
        raise StoreError(f"There are no credentials for {place}.", hint=f"Set {_SETTINGS}.") from error
    except (BotoCoreError, HTTPClientError, OSError) as error:
        raise StoreError(f"{place} cannot be reached: {_reason(error)}.", hint=_LATER) from error


def _refused(response: dict[str, Any], place: str, key: str) -> StoreError:
    code = str(response.get("Error", {}).get("Code", ""))
    if key and code in _ABSENT:
        return ObjectMissingError(
            f"The object {key} is missing in {place}.",
            hint="Bring it back from a backup of the bucket; `bt-studio admin storage check` lists all.",
        )
    if code in _KNOWN:
        reason, hint = _KNOWN[code]
        return StoreError(f"{place} cannot be used: {reason}.", hint=hint)
    # The text of the other side is shown to users only as a code of letters.
    shown = code if code.isalnum() and len(code) <= 60 else "an unknown error"
    return StoreError(f"{place} refuses: {shown}.", hint=_LATER)


def _reason(error: Exception) -> str:
    return {
        "EndpointConnectionError": "no connection",
        "ConnectTimeoutError": "no connection within 5 s",
        "ReadTimeoutError": "no answer within 30 s",
        "SSLError": "its certificate is not trusted",
    }.get(type(error).__name__, "the connection broke")
