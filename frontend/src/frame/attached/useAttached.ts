import { useEffect, useState } from 'react';
import { api } from '@/api/client';
import type { AttachedTree } from '@/generated/messages';
import { useProjectStore } from '@/store/project';
import { takeBegun } from '@/store/route/begun';
import { joinSession, leave } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';
import { attachedId, detailOf } from './detail';

/** Of a joined session, `isShown` tells whether the tree of the program is known. */
export interface Following {
  /** The address of the program; empty until it is known. */
  readonly address: string;
  readonly isShown: boolean;
  /** Why the session cannot be joined. */
  readonly error: Error | null;
  readonly hasEnded: boolean;
}

const BEGIN: Following = { address: '', isShown: false, error: null, hasEnded: false };

/** Joins a session that follows a program, and loads its tree whenever the program has another one. */
export function useAttached(sessionId: string): Following {
  const [following, setFollowing] = useState(BEGIN);
  useEffect(() => {
    let isLeft = false;
    let loaded: AttachedTree | null = null;
    const change = (part: Partial<Following>) => {
      if (!isLeft) setFollowing((before) => ({ ...before, ...part }));
    };
    const join = async () => {
      const found = takeBegun(sessionId) ?? (await api.getSession(sessionId));
      if (isLeft) return;
      const address = found.target;
      change({ address });
      if (found.state === 'ended' || found.state === 'failed') {
        return change({ hasEnded: true, error: found.error ? new Error(found.error) : null });
      }
      const show = (tree: AttachedTree | null) => {
        if (tree === null || JSON.stringify(tree) === JSON.stringify(loaded)) return;
        loaded = tree;
        useProjectStore.getState().load(detailOf(tree, address));
        change({ isShown: true });
      };
      unfollow = useSessionStore.subscribe((now, before) => {
        if (now.attachedTree !== before.attachedTree) show(now.attachedTree);
      });
      await joinSession(found, attachedId(address));
    };
    let unfollow: (() => void) | null = null;
    join().catch((error: unknown) => {
      change({ error: error instanceof Error ? error : new Error(String(error)) });
    });
    return () => {
      isLeft = true;
      unfollow?.();
      leave();
      useProjectStore.getState().close();
    };
  }, [sessionId]);
  return following;
}
