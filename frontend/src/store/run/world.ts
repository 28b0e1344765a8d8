import { create } from 'zustand';

/** Where the next runs take place, when that differs from the project's own setting. */
interface WorldChoice {
  /** Null: the project's universe. */
  universe: string | null;
  robot: string | null;
  /** What random places and the noise of sensors are drawn from. */
  seed: number;
}

/** Lives as long as the page: a world tried once is not written into the project. */
export const useWorldChoice = create<WorldChoice>(() => ({ universe: null, robot: null, seed: 0 }));

/** The universe and robot of the next run, out of what the project has and what was chosen for once. */
export function chosenWorld<T>(
  own: { universe: T; robot: string | null },
  documentOf: (universe: string) => string | null,
): { universe: T | string | { document: string }; robot: string | null; seed: number } {
  const { universe, robot, seed } = useWorldChoice.getState();
  if (universe === null) return { universe: own.universe, robot: robot ?? own.robot, seed };
  const document = documentOf(universe);
  return { universe: document === null ? universe : { document }, robot: robot ?? own.robot, seed };
}
