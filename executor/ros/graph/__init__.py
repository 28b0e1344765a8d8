"""The ROS graph around a world: its ends, topic tools for clients, mismatches, and taps for recordings."""
