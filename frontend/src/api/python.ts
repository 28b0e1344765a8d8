import type { components } from '@/generated/api';

/** A place in a source; both count from 1, columns in code points. */
export type PythonPlace = Readonly<components['schemas']['Place']>;

/** A finding of ruff, with the edits that fix it. */
export type PythonFinding = Readonly<components['schemas']['Finding']>;
