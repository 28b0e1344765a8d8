/** Port declarations, and the meaning of port values. */

import { namesOf, STATUSES } from './values';

export type PortDirection = 'input' | 'output' | 'inout';

export interface PortSpec {
  readonly name: string;
  readonly direction: PortDirection;
  /**
   * `int`, `uint`, `double`, `bool`, `string`, `status`, `script`, `any`, `list[…]`, an enumeration with its
   * names (`Color[RED;GREEN]`), or a type that an action declares.
   */
  readonly type: string;
  readonly default: string | null;
  readonly required: boolean;
  readonly description: string;
}

/**
 * Returns whether a port can have this name: in XML a port is an attribute, and some attributes are reserved.
 */
export const canBePort = (name: string): boolean =>
  /^[A-Za-z][\w.-]*$/.test(name) && name !== 'name' && name !== 'ID';

export type PortText =
  | { readonly kind: 'empty' }
  | { readonly kind: 'literal'; readonly text: string }
  | { readonly kind: 'key'; readonly key: string; readonly global: boolean }
  | { readonly kind: 'same-name' }
  | { readonly kind: 'broken'; readonly reason: 'unclosed' | 'empty-key' | 'bad-key' };

const OUTER_BLANKS = /^ +| +$/g;

/** Returns the key in the braces of `{key}`, or `=` for `{=}`; null for a literal. */
export function pointerOf(text: string): string | null {
  const stripped = text.replace(OUTER_BLANKS, '');
  return stripped.length > 2 && stripped.startsWith('{') && stripped.endsWith('}')
    ? stripped.slice(1, -1)
    : null;
}

const count = (text: string, character: string): number => text.split(character).length - 1;

/** Parses a literal, `{key}`, `{=}` or `{@global_key}`, as in BT.CPP. */
export function readPortText(text: string): PortText {
  const stripped = text.replace(OUTER_BLANKS, '');
  if (stripped.trim() === '') return { kind: 'empty' };
  if (stripped === '{}') return { kind: 'broken', reason: 'empty-key' };
  const looksLikeKey = stripped.startsWith('{') || stripped.endsWith('}');
  const inner = pointerOf(text);
  if (inner === null && looksLikeKey && count(stripped, '{') !== count(stripped, '}')) {
    return { kind: 'broken', reason: 'unclosed' };
  }
  if (inner === null) return { kind: 'literal', text };
  if (inner === '=') return { kind: 'same-name' };
  if (/[{}]|.@/s.test(inner)) return { kind: 'broken', reason: 'bad-key' };
  return inner.startsWith('@')
    ? { kind: 'key', key: inner.slice(1), global: true }
    : { kind: 'key', key: inner, global: false };
}

export type Widget = 'number' | 'integer' | 'boolean' | 'enum' | 'script' | 'text';

const WIDGETS: ReadonlyMap<string, Widget> = new Map([
  ['int', 'integer'],
  ['uint', 'integer'],
  ['double', 'number'],
  ['bool', 'boolean'],
  ['script', 'script'],
]);

export function widgetOf(type: string): Widget {
  return choicesOf(type).length > 0 ? 'enum' : (WIDGETS.get(type) ?? 'text');
}

/** Returns the values of an enumerated type. */
export const choicesOf = (type: string): readonly string[] =>
  type === 'status' ? STATUSES : (namesOf(type) ?? []);
