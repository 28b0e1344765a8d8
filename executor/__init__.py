"""The robotics executor: manager, world and application, each a process of its own."""

__version__ = "0.1.0"
