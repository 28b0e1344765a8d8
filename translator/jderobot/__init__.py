"""Projects of JdeRobot's BT Studio: reads all their formats, and writes the one of 2024."""
