"""The process that runs a user's tree: its crash does not end the session."""
