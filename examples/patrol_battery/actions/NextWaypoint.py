import py_trees

from tree_gardener.ports import Port, get_input, set_output


class NextWaypoint(py_trees.behaviour.Behaviour):
    """Returns the points of a list one by one; after the last one it fails, and then starts again."""

    INPUT_PORTS = {
        "waypoints": Port(str, default="1,0; 1,1; 0,1; 0,0", description="Points in m: x,y; x,y; …"),
        "rounds": Port(int, default=1, description="How often the list is gone through."),
    }
    OUTPUT_PORTS = {
        "x": Port(float, description="The point, in m."),
        "y": Port(float, description="The point, in m."),
    }

    def setup(self, **kwargs):
        self.taken = 0

    def update(self):
        points = [
            tuple(float(number) for number in point.split(","))
            for point in get_input(self, "waypoints").split(";")
            if point.strip()
        ]
        if self.taken >= len(points) * get_input(self, "rounds"):
            self.taken = 0
            return py_trees.common.Status.FAILURE
        x, y = points[self.taken % len(points)]
        self.taken += 1
        set_output(self, "x", x)
        set_output(self, "y", y)
        return py_trees.common.Status.SUCCESS
