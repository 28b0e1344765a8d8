import { actionSpec, type NodeSpec, type Vocabulary } from '@/model/vocabulary';
import type { RecordedNode } from '@/store/recording/types';

/** Adds the types that ran and that the project does not have any more, by their recorded kinds. */
export function withRecorded(present: Vocabulary, nodes: readonly RecordedNode[]): Vocabulary {
  const added = new Map<string, NodeSpec>();
  for (const { type, kind, ports } of nodes) {
    if (present.specs.has(type) || added.has(type)) continue;
    const names = Object.keys(ports).map((name) => ({ name, direction: 'input', type: 'string' }) as const);
    added.set(type, actionSpec({ name: type, kind, open: true, ports: names }));
  }
  return added.size === 0 ? present : { ...present, specs: new Map([...present.specs, ...added]) };
}
