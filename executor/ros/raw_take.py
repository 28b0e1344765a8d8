"""Reads messages of a subscription without an executor."""

from __future__ import annotations

from typing import Any


def take(subscription: Any) -> Any:
    """Removes and returns the next message of a subscription; None if there is none."""
    taken = take_with_info(subscription)
    return None if taken is None else taken[0]


def take_with_info(subscription: Any) -> tuple[Any, dict[str, Any]] | None:
    """Removes and returns the next message with its metadata from the middleware; None if there is none."""
    with subscription.handle:
        taken: tuple[Any, dict[str, Any]] | None = subscription.handle.take_message(
            subscription.msg_type, subscription.raw
        )
    return taken


def ignore(message: object) -> None:
    """Serves as the callback of subscriptions.

    It is never called, since messages are read without an executor.
    """
