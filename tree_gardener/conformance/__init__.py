"""Runs conformance cases: trees with the traces that BehaviorTree.CPP itself produced."""

from tree_gardener.conformance.cases import Outcome, run_case, run_file
from tree_gardener.conformance.deviations import DEVIATIONS

__all__ = ["DEVIATIONS", "Outcome", "run_case", "run_file"]
