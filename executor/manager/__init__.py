"""The manager of one session: the I/O around the state machine."""
