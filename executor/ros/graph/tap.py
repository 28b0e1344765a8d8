"""Takes the messages of topics that other processes publish, for a recording: raw, as CDR.

What the world publishes or receives itself is taken where it is made (`executor.ros.tap`).
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final

from rclpy.node import Node

from executor.recorder.definitions import DefinitionError, full_text
from executor.ros.raw_subscription import DEPTH, LARGE_TYPES, subscribe_raw
from executor.ros.raw_take import take_with_info
from executor.ros.values import message_type

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from rclpy.context import Context

__all__ = ["GraphTap", "share_after"]

LOOK_S: Final = 0.5
POLL_S: Final = 0.1
MOST_TOPICS: Final = 64
NODE: Final = "_bt_studio_recorder"
"""The name of a hidden node: users did not start it, so their lists of nodes do not show it."""
_LEFT_OUT: Final = frozenset({"/rosout", "/parameter_events", "/clock"})


class GraphTap:
    """Subscribes to the topics of a graph that somebody else publishes, soon after they appear.

    Args:
        context: the context of the ROS graph.
        own: the names of topics that are recorded elsewhere.
        write: is called with the topic, the type, the message as CDR, and when it was sent: the share of the
            time since the last look that has passed after it, from 0 to 1.
        note: is called once with a sentence for each topic that is not recorded.
    """

    def __init__(
        self,
        context: Context,
        own: Collection[str],
        write: Callable[[str, str, bytes, float], None],
        note: Callable[[str], None],
    ) -> None:
        self._node = Node(
            NODE,
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )
        self._left_out = _LEFT_OUT | set(own)
        self._write = write
        self._note = note
        self._subscriptions: dict[str, tuple[str, Any]] = {}
        self._refused: set[str] = set()
        self._look_s = 0.0
        self._poll_s = 0.0
        self._polled_ns = time.time_ns()

    def is_due(self, now_s: float) -> bool:
        """Whether to look for messages: ten times in a second of real time, or always where many come."""
        return now_s >= self._poll_s

    def poll(self, now_s: float) -> None:
        """Takes the messages that have arrived; looks for topics twice a second of real time."""
        if now_s >= self._look_s:
            self._look_s = now_s + LOOK_S
            self._look()
        before_ns, self._polled_ns = self._polled_ns, time.time_ns()
        most = max((self._take(*each, before_ns) for each in self._subscriptions.items()), default=0)
        self._poll_s = now_s if most > DEPTH // 4 else now_s + POLL_S

    def restart(self) -> None:
        """Subscribes again, so that the recording of another run has the latched messages too."""
        for _, subscription in self._subscriptions.values():
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()
        self._refused.clear()
        self._look_s = 0.0

    def close(self) -> None:
        """Ends all subscriptions."""
        self._node.destroy_node()

    def _take(self, topic: str, subscribed: tuple[str, Any], before_ns: int) -> int:
        """Takes the messages of a topic; returns how many there were."""
        kind, subscription = subscribed
        for count in range(DEPTH):
            taken = take_with_info(subscription)
            if taken is None:
                return count
            data, info = taken
            share = share_after(info["source_timestamp"], before_ns, self._polled_ns)
            self._write(topic, kind, data, share)
        return DEPTH

    def _look(self) -> None:
        present = {topic for topic, _ in self._node.get_topic_names_and_types()}
        for topic in present - self._left_out - self._refused - self._subscriptions.keys():
            publishers = self._node.get_publishers_info_by_topic(topic)
            if publishers:
                self._add(topic, publishers[0].topic_type)
        for topic in [topic for topic in self._subscriptions if not self._node.count_publishers(topic)]:
            self._node.destroy_subscription(self._subscriptions.pop(topic)[1])

    def _add(self, topic: str, kind: str) -> None:
        reason = self._reason_against(kind)
        if not reason:
            try:
                made = subscribe_raw(self._node, topic, message_type(kind))
            except (ValueError, RuntimeError) as error:
                reason = str(error).partition("\n")[0]
            else:
                self._subscriptions[topic] = kind, made
                return
        self._refused.add(topic)
        self._note(f"{topic} is not recorded: {reason.rstrip('.')}.")

    def _reason_against(self, kind: str) -> str:
        if len(self._subscriptions) >= MOST_TOPICS:
            return f"a recording holds at most {MOST_TOPICS} topics of other processes"
        if kind in LARGE_TYPES:
            return f"messages of the type {kind} are too large; publish a CompressedImage"
        try:
            full_text(kind)
        except DefinitionError as error:
            return str(error)
        return ""


def share_after(sent_ns: int, before_ns: int, now_ns: int) -> float:
    """Returns the share of the time between two looks that has passed after a message was sent, 0 to 1."""
    return min(1.0, max(0.0, (now_ns - sent_ns) / max(1, now_ns - before_ns)))
