"""The pool of this machine: a supervisor, workers, and a forked process for each run."""
