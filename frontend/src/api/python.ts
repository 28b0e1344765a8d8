import type { components } from '@/generated/api';

/** A place in a source. Lines and columns count from 1; columns are in code points. */
export type PythonPlace = Readonly<components['schemas']['Place']>;

/** A finding of ruff, with the edits that fix it. */
export type PythonFinding = Readonly<components['schemas']['Finding']>;
