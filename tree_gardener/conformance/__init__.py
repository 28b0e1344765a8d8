"""Runs conformance cases: trees with the traces that BehaviorTree.CPP itself produced."""

from tree_gardener.conformance.cases import Outcome, run_case, run_file

__all__ = ["Outcome", "run_case", "run_file"]
