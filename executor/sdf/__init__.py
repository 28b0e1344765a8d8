"""Reads SDF: Gazebo's dialect, values with the defaults of the specification, frames, included files."""
