/** What the user searches for. */
export interface Query {
  readonly text: string;
  readonly matchesCase: boolean;
  readonly isWholeWord: boolean;
  readonly isRegex: boolean;
}

/** A query that is not a regular expression, with the reason in the words of the browser. */
export interface WrongQuery {
  readonly wrong: string;
}

const escaped = (text: string): string => text.replace(/[\\^$.*+?()[\]{}|/]/g, '\\$&');

/** The browser's reason without its repetition of the expression. */
function reasonOf(error: unknown, source: string): string {
  const message = error instanceof Error ? error.message : String(error);
  const repeated = `/${source}/`;
  const at = message.indexOf(repeated);
  return at < 0 ? message : message.slice(at + repeated.length).replace(/^\w*:\s*/, '');
}

/** The regular expression of a query; matches are found with its flag `g`. */
export function compile({ text, matchesCase, isWholeWord, isRegex }: Query): RegExp | WrongQuery {
  const flags = matchesCase ? 'gmu' : 'gimu';
  const source = isRegex ? text : escaped(text);
  try {
    const plain = new RegExp(source, flags);
    const letter = '[\\p{L}\\p{N}_]';
    return isWholeWord ? new RegExp(`(?<!${letter})(?:${source})(?!${letter})`, flags) : plain;
  } catch (error) {
    return { wrong: reasonOf(error, source) };
  }
}
