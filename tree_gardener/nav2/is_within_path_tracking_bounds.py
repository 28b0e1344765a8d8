"""IsWithinPathTrackingBounds of Nav2."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import input_or, is_active
from tree_gardener.ports import Port


class IsWithinPathTrackingBounds(Behaviour):
    """Succeeds if the robot follows its path closely.

    It does so if its errors are within the bounds to the left, to the right, and in heading. A positive error
    of position is to the left. A negative bound counts as positive; bounds are read at the start. Without
    feedback it succeeds. Rule: Nav2's plugins/condition/is_within_path_tracking_bounds_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "max_error_left": Port(float, default=0.5, description="The largest error to the left, in m."),
        "max_error_right": Port(float, default=0.5, description="The largest error to the right, in m."),
        "max_error_heading": Port(float, default=3.14, description="The largest error of heading, in rad."),
        "tracking_feedback": Port(description="The controller's feedback: nav2_msgs/TrackingFeedback."),
    }

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.left = self.right = self.heading = 0.0

    def update(self) -> Status:
        if not is_active(self):
            self.left = abs(input_or(self, "max_error_left", self.left))
            self.right = abs(input_or(self, "max_error_right", self.right))
            self.heading = abs(input_or(self, "max_error_heading", self.heading))
        feedback = input_or(self, "tracking_feedback", None)
        if feedback is None:
            return Status.SUCCESS
        error = feedback.position_tracking_error
        is_near = error <= self.left if error >= 0.0 else -error <= self.right
        is_straight = abs(feedback.heading_tracking_error) <= self.heading
        return Status.SUCCESS if is_near and is_straight else Status.FAILURE
