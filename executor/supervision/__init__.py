"""Child processes: starts, supervises, confines and ends them."""
