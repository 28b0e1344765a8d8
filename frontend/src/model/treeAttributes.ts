import type { Diagram } from './diagram';

/**
 * A tree's own metadata: attributes of its `<BehaviorTree>`, which other programs ignore and which stay in
 * its XML.
 */
export const DESCRIPTION = '_description';
export const OFFERED = '_bts_offered';

/** Returns the attributes of a tree; values that are not texts are left out, since files are not checked. */
export function attributesOf({ attributes }: Pick<Diagram, 'attributes'>): Record<string, string> {
  if (typeof attributes !== 'object' || attributes === null || Array.isArray(attributes)) return {};
  return Object.fromEntries(
    Object.entries(attributes).filter((row): row is [string, string] => typeof row[1] === 'string'),
  );
}

/** Returns the author's description of the tree; empty if there is none. */
export const descriptionOf = (diagram: Pick<Diagram, 'attributes'>): string =>
  attributesOf(diagram)[DESCRIPTION] ?? '';

/** Returns whether the tree is offered to other projects in their library. */
export const isOffered = (diagram: Pick<Diagram, 'attributes'>): boolean =>
  attributesOf(diagram)[OFFERED] === '1';
