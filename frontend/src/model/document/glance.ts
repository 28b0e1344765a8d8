/**
 * Reads the name and the robot in a universe's or a robot's YAML without a parser, which the start page does
 * not load.
 */

/** Returns the readable form of an id such as `walled_room`. */
export function titleOf(id: string): string {
  const words = id.replaceAll('_', ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Returns the value on a line of YAML, without its quotes and the comment after it. */
function scalar(text: string): string {
  const quoted = /^"((?:[^"\\]|\\.)*)"|^'((?:[^']|'')*)'/.exec(text);
  if (quoted) return (quoted[1]?.replace(/\\(.)/g, '$1') ?? quoted[2]?.replaceAll("''", "'") ?? '').trim();
  return text.replace(/\s#.*$/, '').trim();
}

/** Returns the name that a document contains; null if it has none on a single line. */
export function nameIn(text: string): string | null {
  const found = /^name:[ \t]+(\S.*)$/m.exec(text)?.[1];
  return found === undefined || /^[|>&*[{]/.test(found) ? null : scalar(found) || null;
}

/** Returns the model of the first robot in a universe; null if there is none. */
export function robotIn(text: string): string | null {
  const robots = /^robots:([^\n]*(?:\n(?:[ \t-].*|#.*|))*)/m.exec(text)?.[1];
  const model = robots === undefined ? undefined : /\bmodel:[ \t]*([^,}\n]+)/.exec(robots)?.[1];
  return model === undefined ? null : scalar(model) || null;
}
