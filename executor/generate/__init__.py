"""Generators: TypeScript types, the page of the protocol, pictures."""
