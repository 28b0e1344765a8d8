"""The manager of one session: the rim around the state machine."""
