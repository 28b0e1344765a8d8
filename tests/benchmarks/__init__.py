"""The benchmarks: `make bench` runs all of them, each beside its competitor in the same run."""
