"""BehaviorTree.CPP XML: writing, reading, and changing a file without touching the rest of it."""
