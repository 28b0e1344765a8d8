/** A document that is open in a tab. */
export type DocumentTab =
  | { kind: 'tree'; id: string }
  | { kind: 'file'; path: string }
  /** Read-only Python outside of the project: from Python's own library, a package, or a stub. */
  | { kind: 'source'; path: string }
  /** The comparison of two revisions; there is only one such tab. */
  | { kind: 'compare' }
  /** The tree as it ran at the shown past moment; there is only one such tab. */
  | { kind: 'past' };
