"""Starts and ends of sessions.

writes       starts, ends and refreshes them
attaching    starts those that follow programs outside
drain        lets none start before an upgrade
orphans      ends what a killed server left
ros_domains  chooses the ROS domain of one
"""
