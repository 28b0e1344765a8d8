"""Received messages as a condition, after ``RosTopicSubNode`` of BehaviorTree.ROS2."""

import re
from typing import Any, ClassVar, Final

from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.errors import PortError, ScriptError
from tree_gardener.ports import node_of
from tree_gardener.ros_nodes.fields import path_of, read
from tree_gardener.ros_nodes.leaf import RosLeaf
from tree_gardener.ros_nodes.publish import quality
from tree_gardener.script import Environment, compile_script
from tree_gardener.status import Status
from tree_gardener.values import ANY

LATEST: Final = "latest"
NEW: Final = "new"
WAIT: Final = "wait"
MODES: Final = (LATEST, NEW, WAIT)

_WORD: Final = re.compile(r"[A-Za-z_]\w*")
_DOTTED: Final = re.compile(r"[A-Za-z_]\w*\.[A-Za-z_]")


class RosSubscribe(RosLeaf):
    """Checks the messages of a topic; their fields are output ports.

    ``latest`` succeeds if any message came, ``new`` if one came since the last tick, and ``wait`` is RUNNING
    until one comes. With a condition on the fields, only messages that meet it count.
    """

    NODE_KIND: ClassVar[str] = "Condition"

    _type: Any = None
    _subscription: Any = None
    _made_for = ("", False, False)
    _message: Any = None
    _is_new = False
    _began_s = 0.0

    def setup(self, **kwargs: Any) -> None:
        """Subscribes, if the topic is known already."""
        super().setup(**kwargs)
        if self.ros is not None and self.literal("topic_type"):
            self._resolve()
            self.check_fields(self._type(), "message")
            self._check_condition()
            if self.literal("topic_name"):
                self._subscribe()

    def initialise(self) -> None:
        """Begins to wait: a message from before does not count for ``wait``."""
        self._began_s = self.now()
        if self._mode() == WAIT and not self.flag("latched", default=False):
            self._is_new = False

    def update(self) -> Status:
        """Looks at the latest message."""
        self._resolve()
        self._subscribe()
        mode = self._mode()
        message = self._message if self._is_new or mode == LATEST else None
        self._is_new = False
        if message is not None and self._suits(message):
            self.give_fields(message, "message")
            return Status.SUCCESS
        if mode != WAIT:
            return Status.FAILURE
        patience_s = self.seconds("timeout", -1)
        return Status.FAILURE if 0 <= patience_s <= self.now() - self._began_s else Status.RUNNING

    def shutdown(self) -> None:
        """Ends the subscription."""
        if self._subscription is not None:
            self.ros.destroy_subscription(self._subscription)
            self._subscription = None

    def _mode(self) -> str:
        mode = str(self.setting("mode", LATEST)).strip()
        if mode not in MODES:
            raise PortError(f"port 'mode': '{mode}' is not one of {', '.join(MODES)}")
        return mode

    def _resolve(self) -> None:
        if self._type is None:
            self.joined()
            self._type = self.interface("topic_type", "", "msg")

    def _subscribe(self) -> None:
        name = self.ros_name("topic_name", "")
        wanted = (name, self.flag("latched", default=False), self.flag("reliable", default=False))
        if self._subscription is None or wanted != self._made_for:
            self.shutdown()
            self._message, self._is_new, self._made_for = None, False, wanted
            # Best effort receives from every publisher; messages from before come from reliable ones only.
            profile = quality(latched=wanted[1], sensor=not any(wanted[1:]))
            self._subscription = self.joined().create_subscription(self._type, name, self._received, profile)

    def _received(self, message: Any) -> None:
        self._message, self._is_new = message, True

    def _check_condition(self) -> None:
        text = self.literal("condition")
        if text:
            try:
                compile_script(text)
            except ScriptError as error:
                nested = (
                    "; write a field of a field with __: pose__position__x" if _DOTTED.search(text) else ""
                )
                raise PortError(f"port 'condition': {error}{nested}") from None

    def _suits(self, message: Any) -> bool:
        """Returns whether the message meets the condition: names in it are fields first, then entries."""
        text = str(self.setting("condition", "")).strip()
        if not text:
            return True
        node, board = node_of(self), Blackboard()
        fields = message.get_fields_and_field_types()
        for word in dict.fromkeys(_WORD.findall(text)):
            path = path_of(word)
            if path[0] in fields:
                board.set(word, read(message, path), ANY, node.uid)
            elif (entry := node.board.find(word)) is not None and entry.value is not EMPTY:
                board.set(word, entry.value, ANY, node.uid)
        try:
            return compile_script(text).test(Environment(board, node.tree.enums, node.uid))
        except ScriptError as error:
            known = ", ".join(fields)
            raise PortError(f"port 'condition': {error}; the message's fields: {known}") from None
