import type { components } from '@/generated/api';
import { dataOf, rest } from './http';
import type { Diagnostic } from './types';

/** Where a node stands in a text; offsets as JavaScript counts. */
export type NodeRange = Readonly<components['schemas']['NodeRange']>;

/** The XML of one tree, and its nodes in the order of the text. */
export type TreeText = components['schemas']['TreeText'];

/** The tree that an edited text stands for; `diagnostics` say why there is no diagram. */
export type ReadTree = Omit<components['schemas']['ReadTreeDone'], 'diagnostics'> & {
  readonly diagnostics: readonly Diagnostic[];
};

/** The translator's two ways between one tree and its XML. */
export const trees = {
  /** `base` and `ids`: an earlier text whose comments and blanks are kept, and the nodes in it. */
  write: (diagram: string, base = '', ids: readonly string[] = []): Promise<TreeText> =>
    dataOf(rest.POST('/api/v1/trees/xml', { body: { diagram, base, ids: [...ids] } })),
  read: (xml: string, diagram: string): Promise<ReadTree> =>
    dataOf(rest.POST('/api/v1/trees/diagram', { body: { xml, diagram } })),
};
