const LONGEST = 100;

/**
 * Returns the key in `settings:problem` of the reason why a project cannot have this name; null if it can.
 * The server has the same rules.
 */
export function projectNameProblem(name: string): 'empty' | 'long' | 'path' | null {
  const clean = name.trim();
  if (clean === '') return 'empty';
  if ([...clean].length > LONGEST) return 'long';
  return /[/\\]|^\.+$/.test(clean) ? 'path' : null;
}
