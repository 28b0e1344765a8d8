"""Nav2's nodes in four ROS distributions: tables, sources, and the distribution that a project needs."""
