import { create } from 'zustand';
import { useStore } from 'zustand';
import type { Scene } from '@/generated/messages';
import { usePastLive, useLiveStore, type LiveState } from '@/store/project/live';
import type { Moment, Overview, RecordedNode } from '@/store/recording/types';
import type { RecordedTree } from './recordedTrees';

interface MomentData {
  /** The moment at which the user looks, in s; null: the present. */
  readonly t: number | null;
  /** Of several ticks of that time, the one that is shown; null: the last. */
  readonly tick: number | null;
  /** The shown moment; it lags behind `t` while the recording is read. Null: the present. */
  readonly shown: Moment | null;
  /** The nodes that ran at the shown moment. */
  readonly tree: readonly RecordedNode[];
  /** The trees that ran, the main tree first. */
  readonly trees: Readonly<Record<string, RecordedTree>>;
  /** The recorded world of the shown moment. */
  readonly scene: Scene | null;
  /** The part of the recording that was read. */
  readonly overview: Overview | null;
  /** Why a part of the recording cannot be read; empty if nothing is wrong. */
  readonly failure: string;
  readonly isPlaying: boolean;
  /** The ratio of shown to real time. */
  readonly speed: number;
}

export const PLAY_SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10] as const;

export const atPresent: MomentData = {
  t: null,
  tick: null,
  shown: null,
  tree: [],
  trees: {},
  scene: null,
  overview: null,
  failure: '',
  isPlaying: false,
  speed: 1,
};

/** The moment that all views show. Only `looking.ts` changes it. */
export const useMoment = create<MomentData>(() => atPresent);

export const isLookingBack = (): boolean => useMoment.getState().t !== null;
export const useIsBack = (): boolean => useMoment((state) => state.t !== null);

/** Returns statuses, flashes and faults of the shown moment. */
export function useShownLive<T>(selector: (state: LiveState) => T): T {
  const isBack = useMoment((state) => state.shown !== null);
  return useStore(isBack ? usePastLive : useLiveStore, selector);
}
