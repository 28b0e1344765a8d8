"""Child processes: starting them, listening to them, confining and ending them."""
