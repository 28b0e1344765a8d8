"""The ROS 2 side of a world: environment, messages, node."""
