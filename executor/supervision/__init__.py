"""Child processes: starting, supervising, confining and ending them."""
