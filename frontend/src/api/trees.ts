import type { components } from '@/generated/api';
import { dataOf, rest } from './http';
import type { Diagnostic } from './types';

/** The place of a node in a text; offsets count UTF-16 units, as JavaScript does. */
export type NodeRange = Readonly<components['schemas']['NodeRange']>;

/** The XML of one tree, and its nodes in the order of the text. */
export type TreeText = components['schemas']['TreeText'];

/** The tree that an edited text describes. Without a diagram, `diagnostics` give the reason. */
export type ReadTree = Omit<components['schemas']['ReadTreeDone'], 'diagnostics'> & {
  readonly diagnostics: readonly Diagnostic[];
};

/** The translator's conversions between one tree and its XML. */
export const trees = {
  /**
   * Writes a tree as XML. It keeps the comments and blanks of `base`, an earlier text; `ids` are the nodes in
   * that text.
   */
  write: (diagram: string, base = '', ids: readonly string[] = []): Promise<TreeText> =>
    dataOf(rest.POST('/api/v1/trees/xml', { body: { diagram, base, ids: [...ids] } })),
  read: (xml: string, diagram: string): Promise<ReadTree> =>
    dataOf(rest.POST('/api/v1/trees/diagram', { body: { xml, diagram } })),
};
