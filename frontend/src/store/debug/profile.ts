import { create } from 'zustand';
import type { NodeTime, TreeNode } from '@/generated/messages';
import { shareOf } from '@/model/profile';
import { isLookingBack, useMoment } from '@/store/moment/store';
import { liveKey, type LiveKey } from '@/store/project/live';
import { reported } from '@/store/run/commands';
import { send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';

type Heat = ReadonlyMap<LiveKey, number>;

interface ProfileState {
  /** Whether this page asked to measure the nodes of the session's runs. */
  readonly isWanted: boolean;
  /** The share of each block in the time of all ticks, without the blocks below it, in steps of 1 %. */
  readonly heat: Heat;
}

const NOTHING: Heat = new Map();

export const useProfile = create<ProfileState>(() => ({ isWanted: false, heat: NOTHING }));

/** Measures the nodes of the run, and of later runs, or no longer. */
export async function measure(on: boolean): Promise<void> {
  useProfile.setState({ isWanted: on });
  await reported(send('profile', { on }));
}

/** Measures the nodes, and samples the Python code of one leaf. */
export const sample = ({ uid, path }: TreeNode) => reported(send('profile', { on: true, sample: uid, path }));

/** Returns the share of each block; the nodes of several instances count together. */
export function heatOf(tree: readonly TreeNode[], times: readonly NodeTime[], wholeMs: number): Heat {
  const shares = new Map<LiveKey, number>();
  for (const time of times) {
    const node = tree[time.uid - 1];
    if (!node) continue;
    const key = liveKey(node.tree_id, node.node_id);
    shares.set(key, (shares.get(key) ?? 0) + shareOf(time, wholeMs));
  }
  for (const [key, share] of shares) shares.set(key, Math.round(share * 100) / 100);
  return shares;
}

/** Keeps the heat of the blocks as the session tells it: there is none while the page shows the past. */
export function followHeat(): () => void {
  const show = () => {
    const { tree, profile } = useSessionStore.getState();
    const heat = profile?.on && !isLookingBack() ? heatOf(tree, profile.nodes, profile.tick_ms) : NOTHING;
    if (heat !== useProfile.getState().heat) useProfile.setState({ heat });
  };
  show();
  const stops = [
    useSessionStore.subscribe((now, before) => {
      if (now.profile !== before.profile || now.tree !== before.tree) show();
      // Another session measures nothing.
      if (now.introspection === null && before.introspection !== null)
        useProfile.setState({ isWanted: false });
    }),
    useMoment.subscribe((now, before) => {
      if ((now.t === null) !== (before.t === null)) show();
    }),
  ];
  return () => {
    stops.forEach((stop) => stop());
    useProfile.setState({ isWanted: false, heat: NOTHING });
  };
}
