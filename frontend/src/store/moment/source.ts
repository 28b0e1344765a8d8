import { create } from 'zustand';
import { liveSource } from '@/store/recording/liveSource';
import type { RecordingSource } from '@/store/recording/types';

/** A kept run that is open. */
export interface Kept {
  /** Its id, which its address has. */
  readonly id: string;
  readonly name: string;
}

interface SourceData {
  /** The recording at which the user looks, or would look. */
  readonly source: RecordingSource;
  /** The kept run that is open; null: a run of the session. */
  readonly kept: Kept | null;
}

export const ofSession: SourceData = { source: liveSource, kept: null };

/** Whether it is the recording of the session's last run, whose world is that of the present. */
export const isPresentRun = ({ source }: SourceData): boolean => source === liveSource;

/** The recording of the time axis. Only `looking.ts` changes it. */
export const useSource = create<SourceData>(() => ofSession);
