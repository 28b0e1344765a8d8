import { create } from 'zustand';
import type { TreeNode } from '@/generated/messages';
import { Trace, trace } from '@/store/session/trace/trace';
import { followTimeline } from './looking';
import { identified } from './recordedTrees';

interface Shown {
  /** The statuses of the run that is open; null: those of the present run. */
  readonly recorded: Trace | null;
  readonly nodes: readonly TreeNode[];
}

const present: Shown = { recorded: null, nodes: [] };
const nothing = new Trace();

export const useShownTrace = create<Shown>(() => present);

/** Returns the statuses over time of the run at which the user looks. */
export const shownTrace = (): Trace => useShownTrace.getState().recorded ?? trace;

/** Keeps the timeline of an open run up to date while it is read; returns a function that stops it. */
export function followShownTrace(): () => void {
  const stop = followTimeline((timeline, isPresent) => {
    if (isPresent) return useShownTrace.setState(present);
    if (!timeline) return useShownTrace.setState({ recorded: nothing, nodes: [] });
    const recorded = new Trace(Infinity);
    recorded.start(timeline.nodes, timeline.now);
    recorded.restore(timeline.text, timeline.now);
    const nodes = identified(timeline.nodes.map((node) => ({ ...node, ports: {} })));
    useShownTrace.setState({ recorded, nodes });
  });
  return () => {
    stop();
    useShownTrace.setState(present);
  };
}
