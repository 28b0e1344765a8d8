import { create } from 'zustand';

/** The universe, robot and seed of the next runs, if they differ from the project's settings. */
interface UniverseChoice {
  /** Null: the project's universe. */
  universe: string | null;
  robot: string | null;
  /** The seed of random poses and sensor noise. */
  seed: number;
}

/** Kept until the page closes: a choice for a trial is not saved in the project. */
export const useUniverseChoice = create<UniverseChoice>(() => ({ universe: null, robot: null, seed: 0 }));

/**
 * Returns the universe and robot of the next run, in the form in which the server sent them for this choice.
 */
export function chosenUniverse<T>(own: { universe: T; robot: string | null }): {
  universe: T;
  robot: string | null;
  seed: number;
} {
  const { robot, seed } = useUniverseChoice.getState();
  return { universe: own.universe, robot: robot ?? own.robot, seed };
}
