"""debugpy's adapter as a child of the manager: the Debug Adapter Protocol for Python breakpoints."""
