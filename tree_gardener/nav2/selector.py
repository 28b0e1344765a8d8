"""The rule that all of Nav2's selectors share: the name of a plugin is received on a topic."""

from typing import Any, ClassVar

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import give, input_or, is_active
from tree_gardener.nav2.topics import Topic


class Selector(Behaviour):
    """Writes the name that was last received on the topic, or the default until then.

    It fails if nothing was received and there is no default. A default that was used once stays valid until a
    name is received. When it starts, it subscribes to the topic if that has changed; messages from before the
    subscription count.

    Attributes:
        WHAT: the kind of plugin, which the names of the ports contain.
    """

    WHAT: ClassVar[str] = ""

    def setup(self, **kwargs: Any) -> None:
        self.names = Topic(kwargs.get("node"), "std_msgs", "String", latched=True)
        self.selected = ""
        self.names.follow(input_or(self, "topic_name", ""))

    def update(self) -> Status:
        if not is_active(self):
            self.names.follow(input_or(self, "topic_name", ""))
        message = self.names.take()
        if message is not None:
            self.selected = message.data
        self.selected = self.selected or input_or(self, f"default_{self.WHAT}", "")
        if not self.selected:
            return Status.FAILURE
        give(self, f"selected_{self.WHAT}", self.selected)
        return Status.SUCCESS

    def shutdown(self) -> None:
        self.names.close()
