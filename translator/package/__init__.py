"""What users take away: the ROS 2 package, and the app that the manager runs."""
