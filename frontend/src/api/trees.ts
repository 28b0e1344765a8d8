import { requestJson } from './http';
import type { Diagnostic } from './types';

/** The place of a node in a text; offsets count UTF-16 code units, as in JavaScript. */
export interface NodeRange {
  readonly node: string;
  readonly start: number;
  /** The offset behind its start tag. */
  readonly open_end: number;
  readonly end: number;
}

/** The XML of one tree, and its nodes in the order of the text. */
export interface TreeText {
  readonly xml: string;
  readonly ranges: readonly NodeRange[];
}

/** The tree that results from an edited text. */
export interface ReadTree extends TreeText {
  /** null: the text cannot be read; the diagnostics explain why. */
  readonly diagram: string | null;
  readonly diagnostics: readonly Diagnostic[];
}

/** The translator in both directions: from one tree to its XML, and back. */
export const trees = {
  /** `base` is an earlier text whose comments and blanks are kept; `ids` are the nodes in it. */
  write: (diagram: string, base = '', ids: readonly string[] = []) =>
    requestJson<TreeText>('/trees/xml', { method: 'POST', body: { diagram, base, ids } }),
  read: (xml: string, diagram: string) =>
    requestJson<ReadTree>('/trees/diagram', { method: 'POST', body: { xml, diagram } }),
};
