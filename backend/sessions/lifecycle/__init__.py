"""Starts and ends of sessions.

writes       starts, ends and refreshes them
attaching    starts those that follow programs outside
drain        lets none start before an upgrade
ros_domains  the ROS domains in use on this host
"""
