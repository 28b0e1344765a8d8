"""Nodes with one child, one rule in each module."""
