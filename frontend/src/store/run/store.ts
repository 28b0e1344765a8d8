import { create } from 'zustand';
import type { Diagnostic } from '@/api/types';

/** The steps of Run that come before those of the executor; *Apply* and *Run on* end with `applying`. */
export type LaunchStage = 'saving' | 'checking' | 'starting' | 'launching' | 'applying';

export interface LaunchFailure {
  stage: LaunchStage;
  /** Whether a running tree was to be changed, not a program to be started. */
  isChange?: boolean;
  code: string;
  message: string;
  hint: string;
  /** The project's errors that prevented the run. */
  diagnostics: Diagnostic[];
}

/**
 * The reason why the user cannot run a project: a guest has a read-only link, a viewer watches another page's
 * session; nobody can while the page shows the past.
 */
export type RunBlocker = 'guest' | 'viewer' | 'past';

interface RunData {
  stage: LaunchStage | null;
  failure: LaunchFailure | null;
  /** The value of the edit counter when the running program was started. */
  ranAt: number;
  runBlocker: RunBlocker | null;
  /** The program, by its `ranAt`, for which the user declined a restart. */
  declinedRestart: number | null;
  /** The notice about a takeover by another page that the user has read. */
  readTakeOver: string;
}

export const useRunStore = create<RunData>(() => ({
  stage: null,
  failure: null,
  ranAt: 0,
  runBlocker: null,
  declinedRestart: null,
  readTakeOver: '',
}));
