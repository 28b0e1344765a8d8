"""The protocol of JdeRobot's Robotics Application Manager, for clients of it."""
