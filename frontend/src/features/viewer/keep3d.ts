const KEY = 'bts.keep3d';

/** Returns whether 3D stays although it draws slowly: the user, or a test, chose so. */
export const keeps3d = (): boolean => localStorage.getItem(KEY) !== null;

/** Keeps 3D in this browser from now on. */
export const keep3d = (): void => localStorage.setItem(KEY, 'yes');
