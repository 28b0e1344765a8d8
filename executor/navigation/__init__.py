"""Navigation that needs no Nav2: a map of the world, a planner, a controller and recoveries.

The modules but `server` are pure: times and poses are arguments.
"""
