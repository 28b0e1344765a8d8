import { create } from 'zustand';
import {
  changed,
  existing,
  followed,
  MOST_BREAKPOINTS,
  readBreakpoints,
  toggled,
  type BlockBreakpoint,
} from '@/model/breakpoints';
import { useProjectStore } from '@/store/project';
import { liveKey, type LiveKey } from '@/store/project/live';

type Breakpoints = ReadonlyMap<LiveKey, BlockBreakpoint>;

const byBlock = (list: readonly BlockBreakpoint[]): Breakpoints =>
  new Map(list.map((each) => [liveKey(each.tree_id, each.node_id), each]));

interface BreakpointsData {
  /** All breakpoints; also those of deleted blocks, which *undo* may bring back. */
  readonly list: readonly BlockBreakpoint[];
  /** Whether they have any effect. */
  readonly areOn: boolean;
  /** Why the session refused the last list; empty if it did not. */
  readonly refusal: string;
}

const NONE: BreakpointsData = { list: [], areOn: true, refusal: '' };

/** The breakpoints of this user in the open project. */
export const useBreakpoints = create<BreakpointsData>(() => NONE);

const indices = new WeakMap<readonly BlockBreakpoint[], Breakpoints>();

/** Returns the breakpoint of a block, or undefined. Every block of the canvas asks at each change of one. */
export function breakpointOf({ list }: BreakpointsData, tree: string, node: string) {
  const index = indices.get(list) ?? byBlock(list);
  indices.set(list, index);
  return index.get(liveKey(tree, node));
}

/** Returns the breakpoints of blocks that exist now. */
export const shownBreakpoints = (): readonly BlockBreakpoint[] =>
  existing(useBreakpoints.getState().list, useProjectStore.getState().diagrams);

/** Sets a breakpoint on a block, or removes it; one that is set switches all on. */
export function toggleBreakpoint(tree: string, node: string): void {
  const { list, areOn } = useBreakpoints.getState();
  const next = toggled(list, tree, node);
  if (next.length > MOST_BREAKPOINTS) return;
  useBreakpoints.setState({ list: next, areOn: areOn || next.length > list.length });
}

/** Changes the breakpoint of a block. */
export const changeBreakpoint = (tree: string, node: string, change: Partial<BlockBreakpoint>) =>
  useBreakpoints.setState(({ list }) => ({ list: changed(list, tree, node, change) }));

export const removeAllBreakpoints = () => useBreakpoints.setState({ list: [] });

/** Switches all breakpoints off, or on again. */
export const switchBreakpoints = () => useBreakpoints.setState(({ areOn }) => ({ areOn: !areOn }));

const keyOf = (user: string, projectId: string) => `bts.breakpoints.${user}.${projectId}`;

/** Loads and keeps a user's breakpoints of the open project, and lets them follow its blocks. */
export function followProject(user: string): () => void {
  load(user, useProjectStore.getState().projectId);
  const stops = [
    useProjectStore.subscribe((now, before) => {
      if (now.projectId !== before.projectId) return load(user, now.projectId);
      if (now.diagrams === before.diagrams) return;
      const { list } = useBreakpoints.getState();
      const next = followed(list, before.diagrams, now.diagrams);
      if (next !== list) useBreakpoints.setState({ list: next });
    }),
    useBreakpoints.subscribe((now, before) => {
      const { projectId } = useProjectStore.getState();
      if (projectId === null || (now.list === before.list && now.areOn === before.areOn)) return;
      const { list, areOn } = now;
      localStorage.setItem(keyOf(user, projectId), JSON.stringify({ list, areOn }));
    }),
  ];
  return () => stops.forEach((stop) => stop());
}

function load(user: string, projectId: string | null): void {
  useBreakpoints.setState({ ...NONE, ...(projectId === null ? {} : kept(keyOf(user, projectId))) });
}

function kept(key: string): Partial<BreakpointsData> {
  try {
    const stored: unknown = JSON.parse(localStorage.getItem(key) ?? '{}');
    if (typeof stored !== 'object' || stored === null) return {};
    const { list, areOn } = stored as Record<string, unknown>;
    return { list: readBreakpoints(list).slice(0, MOST_BREAKPOINTS), areOn: areOn !== false };
  } catch {
    return {}; // The stored text is not readable: begin without.
  }
}
