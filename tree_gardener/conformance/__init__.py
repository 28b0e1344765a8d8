"""Runs conformance cases: trees with the traces that BehaviorTree.CPP itself produced."""

from tree_gardener.conformance.cases import Outcome, run_case, run_file
from tree_gardener.conformance.deviations import DEVIATIONS, Deviation, read_deviations, report

__all__ = ["DEVIATIONS", "Deviation", "Outcome", "read_deviations", "report", "run_case", "run_file"]
