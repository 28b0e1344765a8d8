/** A document that is open in a tab. */
export type DocumentTab =
  | { kind: 'tree'; id: string }
  | { kind: 'file'; path: string }
  /** A revision beside another; there is one such tab. */
  | { kind: 'compare' };
