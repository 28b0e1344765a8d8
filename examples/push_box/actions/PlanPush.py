import math

import py_trees

from tree_gardener.ports import Port, get_input, set_output


class PlanPush(py_trees.behaviour.Behaviour):
    """Computes a start pose, a direction and a distance to push an object to a goal."""

    INPUT_PORTS = {
        "object_x": Port(float, required=True, description="Where the object is, in m."),
        "object_y": Port(float, required=True, description="Where the object is, in m."),
        "goal_x": Port(float, required=True, description="Where it shall be, in m."),
        "goal_y": Port(float, required=True, description="Where it shall be, in m."),
        "reach": Port(
            float, default=0.35, description="From the robot's middle to the object's in contact, in m."
        ),
    }
    OUTPUT_PORTS = {
        "start_x": Port(float, description="Where to start pushing, in m."),
        "start_y": Port(float, description="Where to start pushing, in m."),
        "heading": Port(float, description="The direction to push in, in degrees."),
        "distance": Port(float, description="How far to drive, in m."),
    }

    def update(self):
        x, y, to_x, to_y, reach = (
            get_input(self, name) for name in ("object_x", "object_y", "goal_x", "goal_y", "reach")
        )
        way = math.hypot(to_x - x, to_y - y)
        if way < 0.01:
            return py_trees.common.Status.FAILURE
        run_up = reach + 0.3
        ux, uy = (to_x - x) / way, (to_y - y) / way
        set_output(self, "start_x", x - run_up * ux)
        set_output(self, "start_y", y - run_up * uy)
        set_output(self, "heading", math.degrees(math.atan2(uy, ux)))
        set_output(self, "distance", way + run_up - reach)
        return py_trees.common.Status.SUCCESS
