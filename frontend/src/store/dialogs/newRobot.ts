import { create } from 'zustand';

/** Whether the dialogue for a new robot is open, and its initial choice. */
export const useNewRobot = create<{ base: string | null }>(() => ({ base: null }));

/** The choice that stands for our template instead of one of our robots. */
export const TEMPLATE = 'template';

export const openNewRobot = (base = TEMPLATE) => useNewRobot.setState({ base });
export const closeNewRobot = () => useNewRobot.setState({ base: null });

export const ROBOT_FILE = /^robots\/[^/]+\/robot\.yaml$/;

/** Returns the robots of a project, by id. */
export const ownRobots = (paths: Iterable<string>): string[] =>
  [...paths].filter((path) => ROBOT_FILE.test(path)).map((path) => path.split('/')[1] ?? '');
