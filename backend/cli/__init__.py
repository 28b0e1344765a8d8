"""The `bt-studio` program, the only package that imports all others."""
