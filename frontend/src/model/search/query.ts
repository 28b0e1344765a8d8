/** The user's search. */
export interface Query {
  readonly text: string;
  readonly matchesCase: boolean;
  readonly isWholeWord: boolean;
  readonly isRegex: boolean;
}

/** The answer to a query that is not a valid regular expression, with the browser's reason. */
export interface WrongQuery {
  readonly wrong: string;
}

const escaped = (text: string): string => text.replace(/[\\^$.*+?()[\]{}|/]/g, '\\$&');

/** Returns the browser's reason, without the expression that it repeats. */
function reasonOf(error: unknown, source: string): string {
  const message = error instanceof Error ? error.message : String(error);
  const repeated = `/${source}/`;
  const at = message.indexOf(repeated);
  return at < 0 ? message : message.slice(at + repeated.length).replace(/^\w*:\s*/, '');
}

/** Returns the regular expression of a query, with the flag `g`. */
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
