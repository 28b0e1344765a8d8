import { ownRobots } from '@/store/dialogs/newRobot';
import { OUTSIDE } from './titles';

/** A name that is not in use: the wished one, or with a number. */
export function freeName(wish: string, taken: ReadonlySet<string>): string {
  for (let count = 1; ; count += 1) {
    const name = count === 1 ? wish : `${wish}_${count}`;
    if (!taken.has(name.toLowerCase())) return name;
  }
}

/** Names in use, in small letters, for a new universe; one of them is reserved: it stands for no world. */
export const takenUniverses = (paths: readonly string[]): Set<string> =>
  new Set([
    ...paths.map((path) => /^universes\/([^/]+)\.yaml$/.exec(path)?.[1]?.toLowerCase() ?? ''),
    OUTSIDE,
  ]);

/** Names in use, in small letters, for a new robot. */
export const takenRobots = (paths: readonly string[]): Set<string> =>
  new Set(ownRobots(paths).map((id) => id.toLowerCase()));
