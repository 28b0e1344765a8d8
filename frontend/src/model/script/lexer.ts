import type { ScriptProblem, Span } from './problem';

export interface Token {
  readonly kind: 'real' | 'integer' | 'string' | 'name' | 'operator' | 'end';
  readonly text: string;
  readonly span: Span;
}

const OPERATORS = [
  ...[':=', '+=', '-=', '*=', '/=', '==', '!=', '<=', '>=', '&&', '||', '..'],
  ...['=', '<', '>', '&', '|', '^', '+', '-', '*', '/', '!', '~', '?', ':', '(', ')', ';'],
];
const escaped = OPERATORS.map((each) => each.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')).join('|');

const TOKEN = new RegExp(
  '(?<blank>[ \\t\\r\\n]+)' +
    '|(?<real>[0-9]+(?:\\.[0-9]+(?:[eE][+-]?[0-9]+)?|[eE][+-]?[0-9]+)(?![0-9A-Za-z_]))' +
    '|(?<integer>(?:0[xX][0-9a-fA-F]+(?!\\.)|[0-9]+)(?![0-9A-Za-z_]))' +
    "|(?<string>'[^']*')" +
    '|(?<name>[A-Za-z_@][A-Za-z0-9_]*)' +
    `|(?<operator>${escaped})`,
  'y',
);

const HINTS: Readonly<Record<string, string>> = {
  '%': 'percent',
  '"': 'doubleQuote',
  "'": 'quote',
  '.': 'point',
  ',': 'comma',
  '{': 'brace',
  '}': 'brace',
};

function unknown(text: string, at: number): ScriptProblem {
  const number = /^(?:0[xX][0-9A-Za-z_.]*|[0-9][0-9A-Za-z_]*)/.exec(text.slice(at))?.[0];
  if (number !== undefined) {
    return { kind: 'number', values: { text: number }, span: [at, at + number.length] };
  }
  const character = String.fromCodePoint(text.codePointAt(at) ?? 0);
  const kind = HINTS[character] ?? 'character';
  return { kind, values: { text: character }, span: [at, at + character.length] };
}

/** Splits a script into tokens, the last of kind `end`, or returns the first invalid character. */
export function tokenize(text: string): readonly Token[] | ScriptProblem {
  const tokens: Token[] = [];
  let at = 0;
  while (at < text.length) {
    TOKEN.lastIndex = at;
    const match = TOKEN.exec(text);
    if (!match) return unknown(text, at);
    const end = at + match[0].length;
    const [kind] = Object.entries(match.groups ?? {}).find(([, value]) => value !== undefined) ?? [];
    if (kind !== 'blank') tokens.push({ kind: kind as Token['kind'], text: match[0], span: [at, end] });
    at = end;
  }
  tokens.push({ kind: 'end', text: '', span: [text.length, text.length] });
  return tokens;
}
