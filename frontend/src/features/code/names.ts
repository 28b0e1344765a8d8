import { OUTSIDE } from '@/features/universe/titles';
import { isPythonName } from '@/model/pythonNames';
import type { NamedKind } from '@/store/dialogs/files';

export type NameProblem = 'empty' | 'notIdentifier' | 'notPath' | 'taken' | 'builtin' | 'notId' | 'meansNone';

export function pathFor(kind: NamedKind, name: string): string {
  if (kind === 'action') return `actions/${name}.py`;
  if (kind === 'universe') return `universes/${name}.yaml`;
  if (kind === 'robot') return `robots/${name}/robot.yaml`;
  return kind === 'tree' ? `trees/${name}.json` : name;
}

interface Taken {
  paths: Iterable<string>;
  /** The node types in the catalogue and in the project. */
  types: ReadonlySet<string>;
}

/** Returns the reason why a file cannot have this name; null if it can. */
export function nameProblem(kind: NamedKind, name: string, { paths, types }: Taken): NameProblem | null {
  if (name.trim() === '') return 'empty';
  if (kind === 'action' && !isPythonName(name)) return 'notIdentifier';
  if (kind === 'tree' && !/^[\w.-]+$/.test(name)) return 'notIdentifier';
  if (kind === 'file' && (!/^[\w][\w./-]*$/.test(name) || name.includes('..'))) return 'notPath';
  if ((kind === 'universe' || kind === 'robot') && !/^[A-Za-z_][A-Za-z0-9_-]*$/.test(name)) return 'notId';
  if (kind === 'universe' && name.toLowerCase() === OUTSIDE) return 'meansNone';
  const wanted = pathFor(kind, name).toLowerCase();
  for (const path of paths) if (path.toLowerCase() === wanted) return 'taken';
  return kind === 'action' && types.has(name) ? 'builtin' : null;
}
