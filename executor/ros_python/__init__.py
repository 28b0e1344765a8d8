"""Python parts of ROS 2 of which there is no wheel, under their own names and with their own interfaces.

This folder comes last on the path of the processes that run users' code (`application/compat`), so that
what is really installed wins. Written from the documented behaviour, for what actions do with them; the
packages import each other, rclpy, numpy and messages, and nothing else of BT Studio.
"""
