import { useEffect, useState } from 'react';
import type { Scene } from '@/generated/messages';
import { isPresentRun, useSource } from '@/store/moment/source';
import { useMoment } from '@/store/moment/store';
import { frames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';

/** Returns the world that is shown: of a run that is not the present one, or the last received one; null without a world. */
export function useScene(): Scene | null {
  const [scene, setScene] = useState<Scene | null>(() => frames.scene());
  const hasWorld = useSessionStore(({ executor }) => executor !== 'idle' && executor !== 'connected');
  useEffect(() => frames.listen('scene', setScene), []);
  const isPresent = useSource(isPresentRun);
  const recorded = useMoment((state) => state.scene);
  if (!isPresent) return recorded;
  return hasWorld ? scene : null;
}
