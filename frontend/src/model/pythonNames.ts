const KEYWORDS = new Set(
  'False None True and as assert async await break class continue def del elif else except finally for from global if import in is lambda nonlocal not or pass raise return try while with yield'.split(
    ' ',
  ),
);

/** Returns whether a class and its file can have this name. */
export const isPythonName = (name: string): boolean => /^[A-Za-z_]\w*$/.test(name) && !KEYWORDS.has(name);

/** String literals and comments: a name in them may mean something else, such as a topic. */
const TEXT = String.raw`"""[^]*?"""|'''[^]*?'''|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|#[^\n]*`;

/**
 * Returns a pattern for a name alone, or for the class in the module of the same name: `Turn`, `Turn.Turn`.
 */
const nameOf = (name: string): RegExp =>
  new RegExp(String.raw`(${TEXT})|(?<![\p{L}\p{N}_.])${name}(\.${name})?(?![\p{L}\p{N}_])`, 'gu');

/** Returns a pattern for the module in `from actions.Turn import …`. */
const moduleOf = (name: string): RegExp =>
  new RegExp(String.raw`^(\s*(?:from|import)\s+actions\.)${name}(?![\p{L}\p{N}_])`, 'gmu');

/** Renames a name in a source, except in strings and comments. */
export function withName(source: string, from: string, to: string): string {
  return source
    .replace(moduleOf(from), `$1${to}`)
    .replace(nameOf(from), (whole, text: string | undefined, ofModule: string | undefined) => {
      if (text !== undefined) return whole;
      return ofModule === undefined ? to : `${to}.${to}`;
    });
}

/** Returns whether a source imports this name, also in parentheses over several lines. */
export function importsName(source: string, name: string): boolean {
  const asWord = String.raw`(?<![\p{L}\p{N}_])${name}(?![\p{L}\p{N}_])`;
  const onLine = String.raw`^[ \t]*(?:from|import)\s[^\n#]*${asWord}`;
  const inParentheses = String.raw`^[ \t]*from\s[^\n#(]*\([^)]*${asWord}`;
  return new RegExp(`${onLine}|${inParentheses}`, 'mu').test(source);
}
