"""Detection of hung children: measurements of their beats, and the reaction to a hang."""
