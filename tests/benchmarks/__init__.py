"""The benchmarks: `make bench` runs all of them, each beside its rival in the same run."""
