const LONGEST = 100;

/**
 * Returns the reason why a project cannot have this name, as a key in `settings:problem`; null if it can. The
 * server has the same rules.
 */
export function projectNameProblem(name: string): 'empty' | 'long' | 'path' | null {
  const clean = name.trim();
  if (clean === '') return 'empty';
  if ([...clean].length > LONGEST) return 'long';
  return /[/\\]|^\.+$/.test(clean) ? 'path' : null;
}
