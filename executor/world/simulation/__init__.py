"""A running world: time, streams, and adaptation to the load."""
