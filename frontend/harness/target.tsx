import type { ComponentType } from 'react';
import { targetOf, type Target } from '@/features/inspector/target';
import { useProjectStore } from '@/store/project';

/** A part of the inspector for a block of a tree, as that is now. */
export function shownTarget(tree: string, Part: ComponentType<Target>) {
  return function Shown({ id }: { readonly id: string }) {
    const diagram = useProjectStore((state) => state.diagrams[tree]);
    const vocabulary = useProjectStore((state) => state.vocabulary);
    const target = targetOf(diagram, id, vocabulary);
    return target && <Part {...target} />;
  };
}
