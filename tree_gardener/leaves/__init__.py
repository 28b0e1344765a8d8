"""Nodes without children: the built-in ones, and those made from py_trees behaviours."""
