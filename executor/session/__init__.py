"""The session as a state machine: events in, effects out, no I/O."""
