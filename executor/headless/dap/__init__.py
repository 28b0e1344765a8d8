"""`bt-studio dap`: the Debug Adapter Protocol for behaviour trees, on standard input and output."""
