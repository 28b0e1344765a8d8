"""BehaviorTree.CPP XML: writing, reading, and changing a part of a file."""
