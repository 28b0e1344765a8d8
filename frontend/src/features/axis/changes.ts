import type { Scene } from '@/generated/messages';
import type { MovedAt } from '@/store/recording/types';

const MOST_CHARACTERS = 60;
const DIGITS = 6;

/** A body that moved: how far, and by how much it turned. */
export interface MovedBody {
  readonly id: number;
  readonly name: string;
  readonly metres: number;
  readonly degrees: number;
}

/**
 * Returns the bodies that moved, the farthest first. A body moved as its base did, which is the first of its
 * links in the scene: a wheel turns more than the robot. If the base did not move, the link that moved most counts.
 */
export function movedBodies(poses: readonly MovedAt[], scene: Scene | null): MovedBody[] {
  const names = new Map(scene?.objects.map(({ id, body }) => [id, body]));
  const bases = new Set([...new Map(scene?.objects.toReversed().map(({ id, body }) => [body, id])).values()]);
  const found = new Map<string, MovedBody>();
  for (const { id, metres, degrees } of poses) {
    const name = names.get(id) ?? `#${id}`;
    const other = found.get(name);
    if (!other || bases.has(id) || (!bases.has(other.id) && metres > other.metres))
      found.set(name, { id, name, metres, degrees });
  }
  return [...found.values()].sort((one, other) => other.metres - one.metres || other.degrees - one.degrees);
}

/** Returns a value in few characters; one that does not exist is a dash. */
export function shortValue(value: unknown): string {
  if (value === undefined) return '—';
  const text = typeof value === 'string' ? value : JSON.stringify(value, rounded);
  return text.length > MOST_CHARACTERS ? `${text.slice(0, MOST_CHARACTERS)}…` : text;
}

function rounded(_: string, value: unknown): unknown {
  return typeof value === 'number' ? Number(value.toPrecision(DIGITS)) : value;
}
