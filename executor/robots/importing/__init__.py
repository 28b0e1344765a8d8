"""Makes a robot of a project from a URDF, xacro or SDF file, and reports what was taken and what was not."""
