import { useMemo } from 'react';
import type { PortSet } from '@/generated/messages';
import type { DiagramNode } from '@/model/diagram';
import type { LiveKey } from '@/store/project/live';
import { liveKey } from '@/store/project/live';
import { useSessionStore } from '@/store/session/store';
import { useLivePorts, type PortRefusal } from './livePorts';

/** The state of a changed port in the running program. */
export interface PortMark {
  readonly state: 'taken' | 'next_start' | 'fixed' | 'refused';
  /** The text with which the program was started; null: none. */
  readonly saved: string | null;
  /** The reason for a refusal, otherwise "". */
  readonly message: string;
}

export type PortMarks = ReadonlyMap<string, PortMark>;

type Sets = Readonly<Record<string, PortSet>>;

const grouped = new WeakMap<Sets, ReadonlyMap<LiveKey, readonly PortSet[]>>();

/** Returns the changed ports by block, cached for each state. */
function byBlock(sets: Sets): ReadonlyMap<LiveKey, readonly PortSet[]> {
  const known = grouped.get(sets);
  if (known) return known;
  const blocks = new Map<LiveKey, PortSet[]>();
  for (const set of Object.values(sets)) {
    const key = liveKey(set.tree_id, set.node_id);
    blocks.set(key, [...(blocks.get(key) ?? []), set]);
  }
  grouped.set(sets, blocks);
  return blocks;
}

interface Known {
  readonly sets: readonly PortSet[];
  readonly refused: Readonly<Record<string, PortRefusal>>;
  readonly kept: Readonly<Record<string, string | null>>;
}

/** Returns the ports of a block that differ from those with which the program was started. */
export function marksOf(ports: DiagramNode['ports'], { sets, refused, kept }: Known): PortMarks {
  const marks = new Map<string, PortMark>();
  for (const { port, saved, value, effect } of sets) {
    if (value !== (ports?.[port] ?? null)) continue;
    marks.set(port, { state: effect === 'next_start' ? effect : 'taken', saved, message: '' });
  }
  for (const [port, { value, before, code, message }] of Object.entries(refused)) {
    if (value !== (ports?.[port] ?? null)) continue;
    const saved = sets.find((set) => set.port === port)?.saved ?? before;
    marks.set(port, { state: code === 'port_fixed' ? 'fixed' : 'refused', saved, message });
  }
  for (const [port, mark] of marks) {
    const saved = kept[port] === undefined ? mark.saved : kept[port];
    if ((ports?.[port] ?? null) === saved) marks.delete(port);
    else marks.set(port, { ...mark, saved });
  }
  return marks;
}

const NO_SETS: readonly PortSet[] = [];
const NOTHING = {};

/** Returns the marks of a block's ports; any part of the page can show them. */
export function usePortMarks(tree: string, node: string, ports: DiagramNode['ports']): PortMarks {
  const key = liveKey(tree, node);
  const sets = useSessionStore((state) => byBlock(state.ports).get(key)) ?? NO_SETS;
  const refused = useLivePorts((state) => state.refused[key]) ?? NOTHING;
  const kept = useLivePorts((state) => state.kept[key]) ?? NOTHING;
  return useMemo(() => marksOf(ports, { sets, refused, kept }), [ports, sets, refused, kept]);
}
