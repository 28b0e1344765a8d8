import { requestJson } from './http';
import type { Diagnostic } from './types';

/** Where a node stands in a text; offsets as JavaScript counts. */
export interface NodeRange {
  readonly node: string;
  readonly start: number;
  /** Behind its start tag. */
  readonly open_end: number;
  readonly end: number;
}

/** The XML of one tree, and its nodes in the order of the text. */
export interface TreeText {
  readonly xml: string;
  readonly ranges: readonly NodeRange[];
}

/** The tree that an edited text stands for. */
export interface ReadTree extends TreeText {
  /** null: the text cannot be read, and the diagnostics say why. */
  readonly diagram: string | null;
  readonly diagnostics: readonly Diagnostic[];
}

/** The translator's two ways between one tree and its XML. */
export const trees = {
  /** `base` and `ids`: an earlier text whose comments and blanks are kept, and the nodes in it. */
  write: (diagram: string, base = '', ids: readonly string[] = []) =>
    requestJson<TreeText>('/trees/xml', { method: 'POST', body: { diagram, base, ids } }),
  read: (xml: string, diagram: string) =>
    requestJson<ReadTree>('/trees/diagram', { method: 'POST', body: { xml, diagram } }),
};
