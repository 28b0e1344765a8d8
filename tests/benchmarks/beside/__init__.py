"""Compares this tree with another revision: `python -m tests.benchmarks NAME… --beside REVISION`."""
