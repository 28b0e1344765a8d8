import { useMemo } from 'react';
import { marksOfSession } from '@/store/moment/flags';
import { lookAtMark } from '@/store/moment/lookAtMark';
import { extent } from '@/store/moment/looking';
import { isPresentRun, useSource } from '@/store/moment/source';
import { useMoment } from '@/store/moment/store';
import type { Mark } from '@/store/recording/types';
import { useSessionStore } from '@/store/session/store';
import { marksOf } from './strip';

/** Marks of less distance, in s, are one moment. */
const SAME_S = 1e-6;

/** Returns all marks of a run that is shown on the axis, in order. */
function marksOfRun(run: string, from: number): Mark[] {
  const { overview } = useMoment.getState();
  const isPresent = isPresentRun(useSource.getState());
  return marksOf(
    overview?.run === run ? overview : null,
    isPresent ? useSessionStore.getState().logs : [],
    from,
    isPresent ? marksOfSession(run) : null,
  );
}

/** All marks of a run that is shown on the axis, in order. */
export function useMarks(run: string, from: number): readonly Mark[] {
  const overview = useMoment((state) => state.overview);
  const logs = useSessionStore((state) => state.logs);
  const flags = useSessionStore((state) => state.flags);
  const stops = useSessionStore((state) => state.stops);
  const isPresent = useSource(isPresentRun);
  // eslint-disable-next-line react-hooks/exhaustive-deps -- these decide what the marks are
  return useMemo(() => marksOfRun(run, from), [run, from, overview, logs, flags, stops, isPresent]);
}

/** Returns the next (1) or previous (-1) mark from a moment. */
export function markFrom(marks: readonly Mark[], t: number, direction: 1 | -1): Mark | null {
  const found =
    direction > 0 ? marks.find((mark) => mark.t > t + SAME_S) : marks.findLast((mark) => mark.t < t - SAME_S);
  return found ?? null;
}

/** Goes to the next or previous mark; at the present, back from its end. */
export function goToMark(direction: 1 | -1): void {
  const now = extent();
  if (!now) return;
  const t = useMoment.getState().t ?? (direction < 0 ? Infinity : now.to);
  const mark = markFrom(marksOfRun(now.run, now.from), t, direction);
  if (mark) lookAtMark(mark);
}
