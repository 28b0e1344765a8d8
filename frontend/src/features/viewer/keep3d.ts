const KEY = 'bts.keep3d';

/** Returns whether 3D stays although it is slow: the user or a test has chosen so. */
export const keeps3d = (): boolean => localStorage.getItem(KEY) !== null;

/** Stores the choice to keep 3D in this browser. */
export const keep3d = (): void => localStorage.setItem(KEY, 'yes');
