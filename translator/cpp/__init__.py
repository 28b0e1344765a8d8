"""Packages for BehaviorTree.CPP 4: trees, and skeletons in C++ of the project's own nodes, as a plugin."""
