import { ownRobots } from '@/store/dialogs/newRobot';
import { OUTSIDE } from './titles';

/** Returns a name that is not in use: the wanted one, or one with a number. */
export function freeName(wish: string, taken: ReadonlySet<string>): string {
  for (let count = 1; ; count += 1) {
    const name = count === 1 ? wish : `${wish}_${count}`;
    if (!taken.has(name.toLowerCase())) return name;
  }
}

/**
 * Returns the names, in lower case, that a new universe cannot have. One of them is reserved: it means that
 * there is no world.
 */
export const takenUniverses = (paths: readonly string[]): Set<string> =>
  new Set([
    ...paths.map((path) => /^universes\/([^/]+)\.yaml$/.exec(path)?.[1]?.toLowerCase() ?? ''),
    OUTSIDE,
  ]);

/** Returns the names, in lower case, that a new robot cannot have. */
export const takenRobots = (paths: readonly string[]): Set<string> =>
  new Set(ownRobots(paths).map((id) => id.toLowerCase()));
