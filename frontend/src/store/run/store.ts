import { create } from 'zustand';
import type { Diagnostic } from '@/api/types';

/** The steps of Run before those of the executor. */
export type LaunchStage = 'saving' | 'checking' | 'starting' | 'launching';

export interface LaunchFailure {
  stage: LaunchStage;
  code: string;
  message: string;
  hint: string;
  /** Errors of the project, when they are what stopped the run. */
  diagnostics: Diagnostic[];
}

/** Why someone may not run a project: they came by a read-only link, or view another user's session. */
export type RunBlocker = 'guest' | 'viewer';

interface RunData {
  stage: LaunchStage | null;
  failure: LaunchFailure | null;
  /** The project's edits that the running application has. */
  ranAt: number;
  runBlocker: RunBlocker | null;
}

export const useRunStore = create<RunData>(() => ({
  stage: null,
  failure: null,
  ranAt: 0,
  runBlocker: null,
}));
