import { create } from 'zustand';

/** The state of the dialogue for a new robot: the initial choice while it is open, otherwise null. */
export const useNewRobot = create<{ base: string | null }>(() => ({ base: null }));

/** The choice of the template instead of a built-in robot. */
export const TEMPLATE = 'template';

export const openNewRobot = (base = TEMPLATE) => useNewRobot.setState({ base });
export const closeNewRobot = () => useNewRobot.setState({ base: null });

export const ROBOT_FILE = /^robots\/[^/]+\/robot\.yaml$/;

/** Returns the ids of a project's robots. */
export const ownRobots = (paths: Iterable<string>): string[] =>
  [...paths].filter((path) => ROBOT_FILE.test(path)).map((path) => path.split('/')[1] ?? '');
