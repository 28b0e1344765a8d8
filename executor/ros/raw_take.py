"""Takes messages of a subscription without an executor."""

from __future__ import annotations

from typing import Any


def take(subscription: Any) -> Any:
    """Takes one message; None if there is none."""
    taken = take_with_info(subscription)
    return None if taken is None else taken[0]


def take_with_info(subscription: Any) -> tuple[Any, dict[str, Any]] | None:
    """Takes one message with its metadata of the middleware."""
    with subscription.handle:
        taken: tuple[Any, dict[str, Any]] | None = subscription.handle.take_message(
            subscription.msg_type, subscription.raw
        )
    return taken


def ignore(message: object) -> None:
    """Placeholder callback, never called: messages are taken, and no executor spins the node."""
