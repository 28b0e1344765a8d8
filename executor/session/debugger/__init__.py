"""The debugger in a session: holds of the tree, and their end."""
