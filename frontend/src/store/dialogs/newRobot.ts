import { create } from 'zustand';

/** Whether the dialogue for a new robot is open, and which robot it offers first. */
export const useNewRobot = create<{ base: string | null }>(() => ({ base: null }));

/** What is made of our template instead of a robot that we ship. */
export const TEMPLATE = 'template';

export const openNewRobot = (base = TEMPLATE) => useNewRobot.setState({ base });
export const closeNewRobot = () => useNewRobot.setState({ base: null });

export const ROBOT_FILE = /^robots\/[^/]+\/robot\.yaml$/;

/** The robots of a project, by id. */
export const ownRobots = (paths: Iterable<string>): string[] =>
  [...paths].filter((path) => ROBOT_FILE.test(path)).map((path) => path.split('/')[1] ?? '');
