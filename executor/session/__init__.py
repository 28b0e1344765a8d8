"""The session as a state machine: what it hears, what it answers, what it asks for. No I/O."""
