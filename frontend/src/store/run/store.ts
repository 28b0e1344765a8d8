import { create } from 'zustand';
import type { Diagnostic } from '@/api/types';

/** The steps of Run before those of the executor. */
export type LaunchStage = 'saving' | 'checking' | 'starting' | 'launching';

export interface LaunchFailure {
  stage: LaunchStage;
  code: string;
  message: string;
  hint: string;
  /** The project's errors that prevented the run. */
  diagnostics: Diagnostic[];
}

/**
 * The reason why a user cannot run a project: guests use a read-only link, viewers watch another page's
 * session.
 */
export type RunBlocker = 'guest' | 'viewer';

interface RunData {
  stage: LaunchStage | null;
  failure: LaunchFailure | null;
  /** The edit counter of the program that is running. */
  ranAt: number;
  runBlocker: RunBlocker | null;
  /** The run for which the user declined a restart, by its `ranAt`. */
  declinedRestart: number | null;
  /** The notice about another page's control that the user has read. */
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
