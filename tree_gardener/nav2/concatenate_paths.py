"""ConcatenatePaths of Nav2."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.geometry import copied
from tree_gardener.nav2.reading import give, input_or
from tree_gardener.ports import Port


class ConcatenatePaths(Behaviour):
    """Writes a path that follows the first path and then the second.

    Its header is that of the first path, or of the second if that of the first is empty. It fails if both are
    empty. Rule: Nav2's plugins/action/concatenate_paths_action.cpp.
    """

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {
        "input_path1": Port(description="The first path."),
        "input_path2": Port(description="The second path."),
    }
    OUTPUT_PORTS = {"output_path": Port(description="The joined path.")}

    def update(self) -> Status:
        paths = [input_or(self, port, None) for port in ("input_path1", "input_path2")]
        given = [path for path in paths if path is not None]
        poses = [pose for path in given for pose in path.poses]
        if not poses:
            return Status.FAILURE
        headers = [path.header for path in given if path.header != type(path.header)()]
        header = headers[0] if headers else given[0].header
        give(self, "output_path", copied(given[0], header=header, poses=poses))
        return Status.SUCCESS
