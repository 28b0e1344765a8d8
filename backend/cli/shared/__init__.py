"""Modules that commands share: errors, stored projects, translation, the file of a backup."""
