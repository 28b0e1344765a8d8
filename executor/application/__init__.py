"""The process that runs a user's tree: it loads, ticks and reports, and never takes the session down."""
