"""The control nodes: one module for each rule."""
