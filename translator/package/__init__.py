"""Exports: the ROS 2 package, and the app that the manager runs."""
