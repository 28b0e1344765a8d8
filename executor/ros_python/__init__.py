"""Python packages of ROS 2 that have no wheels, under their own names and with their own interfaces.

This folder is last on the path of the processes that run users' code (`application/compat`), so that
installed packages take precedence. The packages implement the part of the documented behaviour that actions
use. They import each other, rclpy, numpy and messages, and nothing else of BT Studio.
"""
