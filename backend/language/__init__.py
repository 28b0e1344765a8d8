"""Support for editing Python: a language server for each open page, and the linter ruff."""
