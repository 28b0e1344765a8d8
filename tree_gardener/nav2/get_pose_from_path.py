"""GetPoseFromPath of Nav2."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.geometry import copied
from tree_gardener.nav2.reading import give, input_or
from tree_gardener.ports import Port


class GetPoseFromPath(Behaviour):
    """Writes a pose of the path; negative indices count from the end. It fails if there is no such pose.

    A pose without a frame gets that of the path. Rule: Nav2's plugins/action/get_pose_from_path_action.cpp.
    """

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {
        "path": Port(description="The path."),
        "index": Port(int, default=0, description="Which pose; -1 is the last one."),
    }
    OUTPUT_PORTS = {"pose": Port(description="The pose.")}

    def update(self) -> Status:
        path, index = input_or(self, "path", None), input_or(self, "index", 0)
        count = 0 if path is None else len(path.poses)
        if not -count <= index < count:
            return Status.FAILURE
        pose = path.poses[index]
        if not pose.header.frame_id:
            pose = copied(pose, header=copied(pose.header, frame_id=path.header.frame_id))
        give(self, "pose", pose)
        return Status.SUCCESS
