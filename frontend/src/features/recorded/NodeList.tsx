import { useVirtualizer } from '@tanstack/react-virtual';
import { useMemo, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import type { NodeStatus, TreeNode } from '@/generated/messages';
import { useMoment } from '@/store/moment/store';
import { depthsOf } from './depths';
import classes from './recorded.module.css';

const ROW = 22;

/** All nodes that ran as a list, each instance for itself, with the statuses of the shown moment. */
export function NodeList({ tree }: { readonly tree: readonly TreeNode[] }) {
  const { t } = useTranslation(['axis', 'run']);
  const shown = useMoment((state) => state.shown);
  const scroller = useRef<HTMLDivElement>(null);
  const depths = useMemo(() => depthsOf(tree), [tree]);
  const statuses = useMemo(() => new Map(shown?.statuses), [shown]);
  const passed = useMemo(() => {
    const { statuses: before = [], flashes = [] } = shown?.halted ?? {};
    return new Map([...before, ...flashes, ...(shown?.flashes ?? [])]);
  }, [shown]);
  // The virtualizer has mutable state, so the compiler must not memoise this component.
  // eslint-disable-next-line react-hooks/incompatible-library
  const virtual = useVirtualizer({
    count: tree.length,
    getScrollElement: () => scroller.current,
    estimateSize: () => ROW,
    overscan: 8,
  });
  return (
    // A part that scrolls must be reachable by the keyboard.
    <div
      ref={scroller}
      className={classes['scroller']}
      // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
      tabIndex={0}
      role="group"
      aria-label={t('past.nodes')}
    >
      <ul style={{ height: virtual.getTotalSize() }}>
        {virtual.getVirtualItems().map(({ index, start }) => {
          const node = tree[index];
          if (!node) return null;
          // A result that did not stay is shown rather than the IDLE after it.
          const now = statuses.get(node.uid);
          const status: NodeStatus = now ?? passed.get(node.uid) ?? 'IDLE';
          return (
            <li
              key={node.uid}
              data-status={status}
              data-passed={now === undefined && status !== 'IDLE' ? true : undefined}
              style={{ transform: `translateY(${start}px)` }}
            >
              <span
                className={classes['name']}
                style={{ paddingLeft: (depths[index] ?? 0) * 16 }}
                title={node.path}
              >
                {node.name}
                {node.type === node.name ? null : <span className={classes['type']}>{node.type}</span>}
              </span>
              <span className={classes['status']}>{t(`run:status.${status}`)}</span>
            </li>
          );
        })}
      </ul>
    </div>
  );
}
