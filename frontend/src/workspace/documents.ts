/** A document that is open in a tab. */
export type DocumentTab =
  | { kind: 'tree'; id: string }
  | { kind: 'file'; path: string }
  /** Compares two revisions; there is one such tab. */
  | { kind: 'compare' };
