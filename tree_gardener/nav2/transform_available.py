"""TransformAvailable of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.reading import input_or, is_active
from tree_gardener.ports import Port


class TransformAvailable(Behaviour):
    """Succeeds if a transform between two frames is known; after the first success it always succeeds.

    Frames that are missing or empty are an error. Rule: Nav2's
    plugins/condition/transform_available_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "child": Port(str, default="", description="The child frame."),
        "parent": Port(str, default="", description="The parent frame."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.frames = Frames(self, kwargs.get("node"))
        self.child = self.parent = ""
        self.was_found = False

    def update(self) -> Status:
        if not is_active(self):
            self.child = input_or(self, "child", self.child)
            self.parent = input_or(self, "parent", self.parent)
            if not self.child or not self.parent:
                raise ValueError("the ports child and parent must both name a frame")
        self.was_found = self.was_found or self.frames.can_transform(self.child, self.parent)
        return Status.SUCCESS if self.was_found else Status.FAILURE
