"""TruncatePath of Nav2."""

import math

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.geometry import copied, distance
from tree_gardener.nav2.reading import give, input_or
from tree_gardener.ports import Port


class TruncatePath(Behaviour):
    """Writes the path without its end: poses nearer to the last one than `distance` are removed.

    At least two poses stay, if the path had so many. The new last pose is turned towards the old last pose.
    An empty path is written unchanged. Rule: Nav2's plugins/action/truncate_path_action.cpp.
    """

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {
        "input_path": Port(description="The path."),
        "distance": Port(float, default=1.0, description="The distance to the goal, in m."),
    }
    OUTPUT_PORTS = {"output_path": Port(description="The truncated path.")}

    def update(self) -> Status:
        path = input_or(self, "input_path", None)
        if path is None or not path.poses:
            if path is not None:
                give(self, "output_path", path)
            return Status.SUCCESS
        goal, poses = path.poses[-1], list(path.poses)
        least = input_or(self, "distance", 1.0)
        while len(poses) > 2 and distance(poses[-1], goal) < least:
            poses.pop()
        last = poses[-1]
        x, y = goal.pose.position.x, goal.pose.position.y
        angle = math.atan2(y - last.pose.position.y, x - last.pose.position.x)
        angle = 0.0 if math.isnan(angle) else angle
        turn = type(last.pose.orientation)(x=0.0, y=0.0, z=math.sin(angle / 2), w=math.cos(angle / 2))
        poses[-1] = copied(last, pose=copied(last.pose, orientation=turn))
        give(self, "output_path", copied(path, poses=poses))
        return Status.SUCCESS
