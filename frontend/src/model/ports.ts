/** Ports: their declarations, and what the text of a value means. */

export type PortDirection = 'input' | 'output' | 'inout';

export interface PortSpec {
  readonly name: string;
  readonly direction: PortDirection;
  /** `int`, `uint`, `double`, `bool`, `string`, `status`, `script`, `any`, `list[…]` or an action's own. */
  readonly type: string;
  readonly default: string | null;
  readonly required: boolean;
  readonly description: string;
}

export type PortText =
  | { readonly kind: 'empty' }
  | { readonly kind: 'literal'; readonly text: string }
  | { readonly kind: 'key'; readonly key: string; readonly global: boolean }
  | { readonly kind: 'same-name' }
  | { readonly kind: 'broken'; readonly reason: 'unclosed' | 'empty-key' };

/** A literal, `{key}`, `{=}` or `{@global_key}`, as in BT.CPP. */
export function readPortText(text: string): PortText {
  const trimmed = text.trim();
  if (trimmed === '') return { kind: 'empty' };
  const opens = trimmed.startsWith('{') || trimmed.startsWith('${');
  if (!opens) return { kind: 'literal', text };
  if (!trimmed.endsWith('}')) return { kind: 'broken', reason: 'unclosed' };
  const inner = trimmed.slice(trimmed.indexOf('{') + 1, -1).trim();
  if (inner === '') return { kind: 'broken', reason: 'empty-key' };
  if (inner === '=') return { kind: 'same-name' };
  // A JSON object is a literal, not a key.
  if (/[":,]/.test(inner)) return { kind: 'literal', text };
  return inner.startsWith('@')
    ? { kind: 'key', key: inner.slice(1), global: true }
    : { kind: 'key', key: inner, global: false };
}

export type Widget = 'number' | 'integer' | 'boolean' | 'enum' | 'script' | 'text';

const INTEGERS = new Set([
  'int',
  'uint',
  'integer',
  'int64',
  'int64_t',
  'uint64_t',
  'unsigned',
  'unsigned int',
]);
const NUMBERS = new Set(['double', 'float', 'number']);
const BOOLEANS = new Set(['bool', 'boolean']);
const STATUSES = ['SUCCESS', 'FAILURE', 'RUNNING', 'SKIPPED'] as const;

export function widgetOf(type: string): Widget {
  const plain = type.toLowerCase();
  if (INTEGERS.has(plain)) return 'integer';
  if (NUMBERS.has(plain)) return 'number';
  if (BOOLEANS.has(plain)) return 'boolean';
  if (plain === 'status' || choicesOf(type).length > 0) return 'enum';
  if (plain === 'script') return 'script';
  return 'text';
}

/** Values of an enumerated type: `status`, or `enum[a,b]`, `Literal['a', 'b']`. */
export function choicesOf(type: string): readonly string[] {
  if (type.toLowerCase() === 'status') return STATUSES;
  const inner = /^(?:enum|literal)\[(.*)\]$/i.exec(type)?.[1];
  return inner ? inner.split(',').map((item) => item.trim().replace(/^['"]|['"]$/g, '')) : [];
}

/** Why a literal does not fit its type, or null. */
export function literalProblem(
  type: string,
  text: string,
): 'number' | 'integer' | 'negative' | 'boolean' | 'enum' | null {
  const value = text.trim();
  switch (widgetOf(type)) {
    case 'integer':
      if (!/^[+-]?\d+$/.test(value)) return 'integer';
      return type.startsWith('u') && value.startsWith('-') ? 'negative' : null;
    case 'number':
      return value !== '' && Number.isFinite(Number(value)) ? null : 'number';
    case 'boolean':
      return /^(true|false|0|1)$/i.test(value) ? null : 'boolean';
    case 'enum':
      return choicesOf(type).includes(value) ? null : 'enum';
    case 'script':
    case 'text':
      return null;
  }
}
