/** A document that is open in a tab. */
export type DocumentTab =
  | { kind: 'tree'; id: string }
  | { kind: 'file'; path: string }
  /** The comparison of two revisions; there is only one such tab. */
  | { kind: 'compare' };
