"""The evaluation beside the ladder of a session."""
