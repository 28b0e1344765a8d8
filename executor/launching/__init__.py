"""Extra nodes of a project: its launch files, and the programs that they ask for."""
