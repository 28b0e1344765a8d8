"""The `bt-studio` program, the one place that imports every part."""
