const LONGEST = 100;

/** Why a project cannot be called so (`settings:problem.<why>`), as the server sees it; null when it can. */
export function projectNameProblem(name: string): 'empty' | 'long' | 'path' | null {
  const clean = name.trim();
  if (clean === '') return 'empty';
  if ([...clean].length > LONGEST) return 'long';
  return /[/\\]|^\.+$/.test(clean) ? 'path' : null;
}
