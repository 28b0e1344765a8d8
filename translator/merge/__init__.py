"""Merges two versions of a tree that come from a common one, by their nodes instead of their lines."""

from translator.merge.files import MergedFile, NotMergeableError, merge_files
from translator.merge.trees import Conflict, merge_documents

__all__ = ["Conflict", "MergedFile", "NotMergeableError", "merge_documents", "merge_files"]
