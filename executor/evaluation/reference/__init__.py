"""The reference pages of the evaluation format."""
