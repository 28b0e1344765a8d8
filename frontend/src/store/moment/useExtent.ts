import { useMemo } from 'react';
import { useSessionStore } from '@/store/session/store';
import { extent, type Extent } from './looking';
import { useSource } from './source';

/** The length of the recording that is open: a kept run, or one of the session; null without one. */
export function useExtent(): Extent | null {
  const segments = useSessionStore((state) => state.segments);
  const source = useSource((state) => state.source);
  // eslint-disable-next-line react-hooks/exhaustive-deps -- both decide what the extent is
  return useMemo(() => extent(), [segments, source]);
}
