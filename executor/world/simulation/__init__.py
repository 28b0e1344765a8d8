"""A running world: time, streams and the load that it adapts to."""
