import { create } from 'zustand';
import { isLookingBack } from '@/store/moment/store';
import { send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';
import type { BodyPose } from './scene/DraggedBody';

/** The last body that was dragged, and its pose before the drag. */
export const useMoves = create<{ last: { body: string; from: BodyPose } | null }>(() => ({ last: null }));

/** Returns whether bodies can be dragged: time is paused, and this page controls the session. */
export function canMove(): boolean {
  const { executor, introspection } = useSessionStore.getState();
  return (
    ['universe_ready', 'visualization_ready', 'paused'].includes(executor) &&
    introspection?.role !== 'viewer' &&
    !isLookingBack()
  );
}

export async function moveBack(): Promise<void> {
  const { last } = useMoves.getState();
  if (!last) return;
  await send('move_body', { id: last.body, pose: last.from });
  useMoves.setState({ last: null });
}
