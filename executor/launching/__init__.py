"""Launch nodes of a project: its launch files, and the programs in them."""
