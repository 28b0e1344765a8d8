"""Projects of JdeRobot's BT Studio: reading all eras of them, and writing the form of 2024."""
