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
  /** The kept run that is open; null: the run of the session. */
  readonly kept: Kept | null;
}

export const ofSession: SourceData = { source: liveSource, kept: null };

/** The recording of the time axis. Only `looking.ts` changes it. */
export const useSource = create<SourceData>(() => ofSession);
