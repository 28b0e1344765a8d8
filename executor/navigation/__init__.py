"""Navigation that needs no Nav2: a map of the world, a planner, a controller and recoveries.

`node` serves it as ROS actions with Nav2's names; `tasks` and `forms` know Nav2's messages. All other modules
are pure: times and poses are arguments.
"""
