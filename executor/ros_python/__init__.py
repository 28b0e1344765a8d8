"""Python parts of ROS 2 without wheels, under their own names and with their own interfaces.

This folder is last on the path of the processes that run users' code (`application/compat`), so that
installed packages take precedence. It implements the part of the documented behaviour that actions use; the
packages import each other, rclpy, numpy and messages, and nothing else of BT Studio.
"""
