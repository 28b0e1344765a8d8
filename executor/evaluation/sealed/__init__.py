"""Sealed runs: the world and the judge in one process, the tree and its actions in another one."""
