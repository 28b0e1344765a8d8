"""Projects of JdeRobot's BT Studio: reads all their formats, and writes the format of 2024."""
