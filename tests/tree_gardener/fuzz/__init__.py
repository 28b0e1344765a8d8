"""Differential fuzzing: the same random trees in the engine and in BehaviorTree.CPP (behaviortreepy)."""
