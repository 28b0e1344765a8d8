import { useVirtualizer } from '@tanstack/react-virtual';
import { useMemo, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import type { NodeStatus, TreeNode } from '@/generated/messages';
import { useSource } from '@/store/moment/source';
import { useMoment } from '@/store/moment/store';
import { depthsOf, isForeign } from './foreign';
import classes from './runs.module.css';

const ROW = 22;

/** The tree of a kept run that is not one of the project's, with its statuses at the shown moment. */
export function RecordedTree() {
  const { t } = useTranslation('runs');
  const isKept = useSource((state) => state.kept !== null);
  const tree = useMoment((state) => state.tree);
  const isShown = useMoment((state) => state.shown !== null);
  if (!isKept || !isShown || !isForeign(tree)) return null;
  return (
    <section className={classes['panel']} aria-label={t('log.nodes')} data-testid="recorded-tree">
      <details open>
        <summary>{t('log.tree', { count: tree.length })}</summary>
        <Rows tree={tree} />
      </details>
    </section>
  );
}

function Rows({ tree }: { readonly tree: readonly TreeNode[] }) {
  const { t } = useTranslation(['runs', 'run']);
  const shown = useMoment((state) => state.shown);
  const scroller = useRef<HTMLDivElement>(null);
  const depths = useMemo(() => depthsOf(tree), [tree]);
  const statuses = useMemo(() => new Map(shown?.statuses), [shown]);
  const flashes = useMemo(() => new Map(shown?.flashes), [shown]);
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
    // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
    <div ref={scroller} className={classes['scroller']} tabIndex={0} role="group" aria-label={t('log.nodes')}>
      <ul style={{ height: virtual.getTotalSize() }}>
        {virtual.getVirtualItems().map(({ index, start }) => {
          const node = tree[index];
          if (!node) return null;
          // A result that did not stay is shown rather than the IDLE after it.
          const now = statuses.get(node.uid);
          const status: NodeStatus = now ?? flashes.get(node.uid) ?? 'IDLE';
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
