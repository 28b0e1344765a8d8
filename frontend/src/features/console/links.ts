export type Piece = { text: string } | { text: string; path: string; line: number };

/**
 * The notations of a line in a file: `Forward.py:12`, `actions/Forward.py:12`, and Python's `File
 * "actions/Forward.py", line 12`.
 */
const LINK = /File "([\w./-]+\.py)", line (\d+)|([\w./-]+\.py):(\d+)/g;

function fileOf(name: string, files: ReadonlySet<string>): string | null {
  const clean = name.replace(/^\.\//, '');
  if (files.has(clean)) return clean;
  const inActions = `actions/${clean.split('/').at(-1) ?? clean}`;
  return files.has(inActions) ? inActions : null;
}

/** Splits a text where it mentions lines of the project's files, so that the mentions can be links. */
export function findLinks(text: string, files: ReadonlySet<string>): Piece[] {
  const pieces: Piece[] = [];
  let end = 0;
  for (const match of text.matchAll(LINK)) {
    const path = fileOf(match[1] ?? match[3] ?? '', files);
    if (!path) continue;
    if (match.index > end) pieces.push({ text: text.slice(end, match.index) });
    pieces.push({ text: match[0], path, line: Number(match[2] ?? match[4]) });
    end = match.index + match[0].length;
  }
  if (end < text.length || pieces.length === 0) pieces.push({ text: text.slice(end) });
  return pieces;
}
