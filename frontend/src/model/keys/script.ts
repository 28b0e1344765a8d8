import { tokenize, type Token } from '../script/lexer';

/** Returns the names in a script, with their places; null if the script has an invalid character. */
function namesIn(text: string): readonly Token[] | null {
  const tokens = tokenize(text);
  return Array.isArray(tokens) ? (tokens as Token[]).filter(({ kind }) => kind === 'name') : null;
}

const CONSTANTS = new Set(['true', 'false']);

/** Returns the keys that a script reads or writes, `@` included. */
export const keysInScript = (text: string): string[] =>
  (namesIn(text) ?? []).map((token) => token.text).filter((name) => !CONSTANTS.has(name));

/** Returns a script with its keys renamed; null if the script has an invalid character. */
export function renameInScript(text: string, rename: (key: string) => string): string | null {
  const names = namesIn(text);
  if (!names) return null;
  let after = '';
  let at = 0;
  for (const { text: name, span } of names) {
    after += text.slice(at, span[0]) + (CONSTANTS.has(name) ? name : rename(name));
    at = span[1];
  }
  return after + text.slice(at);
}
