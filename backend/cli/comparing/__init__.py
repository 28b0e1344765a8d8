"""Commands that compare or merge versions of a project, and their part in git."""
