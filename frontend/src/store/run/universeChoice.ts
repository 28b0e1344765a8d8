import { create } from 'zustand';

/** The universe, robot and seed of the next runs, where they differ from the project's settings. */
interface UniverseChoice {
  /** null: the project's universe. */
  universe: string | null;
  robot: string | null;
  /** The seed of random poses and sensor noise. */
  seed: number;
}

/**
 * The choice for the next runs. It lasts until the page closes and is not saved in the project, since it is
 * for trying something out.
 */
export const useUniverseChoice = create<UniverseChoice>(() => ({ universe: null, robot: null, seed: 0 }));

/** Returns the universe and robot of the next run, as the server sent them for this choice. */
export function chosenUniverse<T>(own: { universe: T; robot: string | null }): {
  universe: T;
  robot: string | null;
  seed: number;
} {
  const { robot, seed } = useUniverseChoice.getState();
  return { universe: own.universe, robot: robot ?? own.robot, seed };
}
