"""Support for writing Python: a language server for each open page, and ruff."""
