"""The robotics executor: manager, world and application, each a process of its own."""
