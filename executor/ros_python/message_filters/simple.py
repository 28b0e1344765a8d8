"""The base class of all filters, and `Subscriber`, the filter of a subscription."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.clock import ROSClock
from rclpy.logging import get_logger
from rclpy.time import Time

if TYPE_CHECKING:
    from collections.abc import Callable

DEFAULT_DEPTH = 10


class SimpleFilter:
    """Base class of filters: it calls the registered callbacks with each output."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., Any], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., Any], *args: Any) -> int:  # noqa: N802 - its name in ROS
        """Registers `cb`, which is called with each output followed by `args`.

        Returns the number of the callback.
        """
        connection = len(self.callbacks)
        self.callbacks[connection] = (cb, args)
        return connection

    def signalMessage(self, *msg: Any) -> None:  # noqa: N802 - its name in ROS
        """Passes an output to all callbacks."""
        for callback, args in list(self.callbacks.values()):
            callback(*msg, *args)


class Subscriber(SimpleFilter):
    """Passes on the messages of a topic: `Subscriber(node, Image, "/image", qos_profile=10)`."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.node, message_type, self.topic, *more = args
        options = dict(zip(("qos_profile",), more[:1], strict=False)) | kwargs
        options.setdefault("qos_profile", DEFAULT_DEPTH)
        self.sub = self.node.create_subscription(message_type, self.topic, self.callback, **options)

    def callback(self, msg: Any) -> None:
        """Passes on a message."""
        self.signalMessage(msg)

    def getTopic(self) -> str:  # noqa: N802 - its name in ROS
        """Returns the topic's name as it was given."""
        return str(self.topic)

    def __getattr__(self, key: str) -> Any:
        """Forwards all other attributes to the subscription."""
        if key == "sub":
            raise AttributeError(key)
        return getattr(self.sub, key)


def stamp_of(message: Any, *, allow_headerless: bool, who: str) -> Time | None:
    """Returns the stamp of a message.

    For a message without header, returns the current time if `allow_headerless` is set, otherwise None.
    """
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    if stamp is not None:
        return stamp if hasattr(stamp, "nanoseconds") else Time.from_msg(stamp)
    if allow_headerless:
        return ROSClock().now()
    get_logger(who).warning(
        f"a {type(message).__name__} has no stamp and is left out; with allow_headerless=True the time at "
        "which it comes would count"
    )
    return None
