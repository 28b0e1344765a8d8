import type { TabNode } from 'flexlayout-react';
import type { ReactNode } from 'react';
import { roleOf, usePresentation } from '@/workspace/presentation';
import { useTabs } from '@/workspace/tabs';

interface PresentedProps {
  readonly node: TabNode;
  readonly children: ReactNode;
}

/** Marks the content of a tab that a presentation shows; the style sheet positions it. */
export function Presented({ node, children }: PresentedProps) {
  useTabs((state) => state.front);
  const role = usePresentation((state) => roleOf(node, state));
  return (
    <div style={{ display: 'contents' }} data-presented={role ?? undefined}>
      {children}
    </div>
  );
}
