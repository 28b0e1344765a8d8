import { create } from 'zustand';

/** Where the next runs take place, when that differs from the project's own setting. */
interface UniverseChoice {
  /** Null: the project's universe. */
  universe: string | null;
  robot: string | null;
  /** The seed of random poses and of sensor noise. */
  seed: number;
}

/** Lives as long as the page: a world tried once is not written into the project. */
export const useUniverseChoice = create<UniverseChoice>(() => ({ universe: null, robot: null, seed: 0 }));

/** The universe, as the server sent it for this choice, and the robot of the next run. */
export function chosenUniverse<T>(own: { universe: T; robot: string | null }): {
  universe: T;
  robot: string | null;
  seed: number;
} {
  const { robot, seed } = useUniverseChoice.getState();
  return { universe: own.universe, robot: robot ?? own.robot, seed };
}
