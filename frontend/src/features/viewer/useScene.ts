import { useEffect, useState } from 'react';
import type { Scene } from '@/generated/messages';
import { frames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';

/** Returns the last received scene; null without a world. */
export function useScene(): Scene | null {
  const [scene, setScene] = useState<Scene | null>(() => frames.scene());
  const hasWorld = useSessionStore(({ executor }) => executor !== 'idle' && executor !== 'connected');
  useEffect(() => frames.listen('scene', setScene), []);
  return hasWorld ? scene : null;
}
