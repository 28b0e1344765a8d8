import { useVirtualizer } from '@tanstack/react-virtual';
import { useEffect, useMemo, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { setCollapsed } from '@/model/edits';
import { outlineRows } from '@/model/outline';
import { change, deleteSelection } from '@/store/project/edits/blocks';
import { openAction } from '@/store/project/navigation';
import { useProjectStore } from '@/store/project';
import { OutlineRow } from './OutlineRow';
import { useRowDrag } from './useRowDrag';
import classes from './Outline.module.css';

const ROW = 28;

/** The tree as indented lines, easy to read and to use with the keyboard. */
export function Outline() {
  const { t } = useTranslation('outline');
  const diagram = useProjectStore((state) => state.diagrams[state.activeTree ?? '']);
  const selection = useProjectStore((state) => state.selection);
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const reveal = useProjectStore((state) => state.reveal);
  const scroller = useRef<HTMLDivElement>(null);
  const list = useRef<HTMLDivElement>(null);
  const rows = useMemo(() => (diagram ? outlineRows(diagram) : []), [diagram]);
  const { slot, onPress, wasDragged } = useRowDrag(list, diagram, rows, ROW);
  const [first] = selection;
  const at = rows.findIndex((row) => row.id === first);
  // The virtualizer has mutable state, so the compiler must not memoise this component.
  // eslint-disable-next-line react-hooks/incompatible-library
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroller.current,
    estimateSize: () => ROW,
    overscan: 8,
  });

  useEffect(() => {
    if (at >= 0) virtual.scrollToIndex(at, { align: 'auto' });
  }, [at, virtual]);

  if (!diagram || rows.length === 0) return <p className={classes['empty']}>{t('empty')}</p>;

  const go = (to: number): void => {
    const row = rows[Math.max(0, Math.min(rows.length - 1, to))];
    if (row) reveal(diagram.id, row.id);
  };
  const fold = (collapsed: boolean): void => {
    const row = rows[at];
    if (row?.hasChildren && row.isFolded !== collapsed) {
      change(collapsed ? 'fold' : 'unfold', [setCollapsed(row.id, collapsed)]);
    }
  };

  return (
    <div
      ref={scroller}
      className={classes['outline']}
      data-testid="outline"
      role="tree"
      tabIndex={0}
      aria-label={t('label')}
      aria-activedescendant={first === undefined ? undefined : `outline-${first}`}
      onKeyDown={(event) => {
        const row = rows[at];
        if (event.key === 'ArrowDown') go(at + 1);
        else if (event.key === 'ArrowUp') go(at - 1);
        else if (event.key === 'Home') go(0);
        else if (event.key === 'End') go(rows.length - 1);
        else if (event.key === 'ArrowLeft') fold(true);
        else if (event.key === 'ArrowRight') fold(false);
        else if (event.key === 'Delete') deleteSelection();
        else if (event.key === 'Enter' && row) {
          const type = diagram.nodes[row.id]?.type ?? '';
          if (vocabulary.specs.get(type)?.source === 'action') openAction(type);
        } else return;
        event.preventDefault();
      }}
    >
      <div ref={list} style={{ height: virtual.getTotalSize(), position: 'relative' }} role="presentation">
        {virtual.getVirtualItems().map((item) => {
          const row = rows[item.index];
          const node = row && diagram.nodes[row.id];
          if (!row || !node) return null;
          return (
            <OutlineRow
              key={row.id}
              tree={diagram.id}
              row={row}
              node={node}
              spec={vocabulary.specs.get(node.type)}
              isSelected={selection.includes(row.id)}
              top={item.start}
              mark={slot?.row === row.id ? slot.edge : null}
              onPress={onPress}
              wasDragged={wasDragged}
            />
          );
        })}
      </div>
    </div>
  );
}
