import { create } from 'zustand';
import { api } from '@/api/client';
import type { OfferedAction } from '@/api/types';
import type { RosDistro } from '@/model/rosDistros';
import type { Kind } from '@/model/rules';
import { actionSpec, type NodeSpec } from '@/model/vocabulary';
import { useProjectStore } from './index';
import { distributionOf } from './edits/distribution';
import { actionPath } from './state';

interface OfferedState {
  /** The specs of the nodes that the palette offers, by name. */
  readonly specs: readonly NodeSpec[];
  /** The source of each offered action, by its name. */
  readonly sources: ReadonlyMap<string, string>;
}

/** The nodes of Nav2 that a project can take: a block that is added brings the source of its action. */
export const useOfferedStore = create<OfferedState>()(() => ({ specs: [], sources: new Map() }));

export function offer(actions: readonly OfferedAction[]): void {
  useOfferedStore.setState({
    specs: actions.map((action) => ({ ...actionSpec(action), source: 'offered' })),
    sources: new Map(actions.map(({ name, text }) => [name, text])),
  });
}

const known = new Map<RosDistro, Promise<OfferedAction[]>>();

/**
 * Offers the nodes of the project's distribution; each is asked for once. Without an answer the palette does
 * not show this family.
 */
async function loadOffered(): Promise<void> {
  const name = distributionOf(useProjectStore.getState());
  const asked = known.get(name) ?? api.offeredActions(name);
  known.set(name, asked);
  try {
    const actions = await asked;
    if (name === distributionOf(useProjectStore.getState())) offer(actions);
  } catch {
    known.delete(name); // the next opening of a project asks again
  }
}

/** Offers what the open project's distribution has, until the returned function is called. */
export function followOffered(): () => void {
  void loadOffered();
  return useProjectStore.subscribe((now, before) => {
    if (distributionOf(now) !== distributionOf(before)) void loadOffered();
  });
}

export const offeredSpec = (type: string): NodeSpec | undefined =>
  useOfferedStore.getState().specs.find((spec) => spec.type === type);

/** Returns the file that a new block of this kind brings; nothing if the project knows the kind. */
export function filesFor({ type }: Kind): { readonly files?: Readonly<Record<string, string>> } {
  const { vocabulary, files } = useProjectStore.getState();
  const source = useOfferedStore.getState().sources.get(type);
  const path = actionPath(type);
  if (source === undefined || vocabulary.specs.has(type) || path in files) return {};
  return { files: { [path]: source } };
}
