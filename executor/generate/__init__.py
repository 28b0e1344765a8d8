"""Generators of TypeScript types, of the protocol's reference page, and of pictures."""
