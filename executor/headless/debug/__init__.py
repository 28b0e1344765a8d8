"""`bt-studio debug`: a debugger of behaviour trees in the terminal, in lock-step with the simulated world."""
