"""Expands xacro in a child with limits: a robot file is a program, and a stranger may have written it."""
