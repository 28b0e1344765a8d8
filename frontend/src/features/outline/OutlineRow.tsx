import { IconChevronRight } from '@tabler/icons-react';
import type { PointerEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { displayName, type DiagramNode, type NodeId } from '@/model/diagram';
import { setCollapsed } from '@/model/edits';
import type { OutlineLine, OutlineSlot } from '@/model/outline';
import type { NodeSpec } from '@/model/vocabulary';
import { breakpointOf, useBreakpoints } from '@/store/debug/breakpoints';
import { useDebugMarks } from '@/store/debug/marks';
import { change } from '@/store/project/edits/blocks';
import { usePaintedStatus, write, type ShownStatus } from '@/store/moment/statusPainter';
import { liveKey } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { FamilyTile } from '@/ui/FamilyTile';
import classes from './Outline.module.css';

interface OutlineRowProps {
  readonly tree: string;
  readonly row: OutlineLine;
  readonly node: DiagramNode;
  readonly spec: NodeSpec | undefined;
  readonly isSelected: boolean;
  readonly top: number;
  /** The place at this line where a dragged line would be dropped; null if there is none. */
  readonly mark: OutlineSlot['edge'] | null;
  readonly onPress: (event: PointerEvent, id: NodeId) => void;
  readonly wasDragged: { readonly current: boolean };
}

function paint(row: Element, { status, past }: ShownStatus): void {
  write(row, 'data-status', past ?? status);
  write(row, 'data-past', past && '');
}

/** One line: symbol, name, type if it differs from the name, and status. The list handles its keys. */
export function OutlineRow(props: OutlineRowProps) {
  const { tree, row, node, spec, isSelected, top, mark, onPress, wasDragged } = props;
  const { t } = useTranslation('outline');
  const root = usePaintedStatus<HTMLDivElement>(liveKey(tree, row.id), paint);
  const held = useDebugMarks((state) => state.held.get(liveKey(tree, row.id)));
  const forced = useDebugMarks((state) => state.forced.get(liveKey(tree, row.id)));
  const breakpoint = useBreakpoints((state) => breakpointOf(state, tree, row.id));
  const areOn = useBreakpoints((state) => state.areOn);
  const name = displayName(node);
  return (
    // eslint-disable-next-line jsx-a11y/click-events-have-key-events
    <div
      ref={root}
      id={`outline-${row.id}`}
      role="treeitem"
      tabIndex={-1}
      aria-level={row.depth + 1}
      aria-selected={isSelected}
      {...(row.hasChildren ? { 'aria-expanded': !row.isFolded } : {})}
      className={classes['row']}
      data-held={held}
      data-disabled={node.disabled || undefined}
      data-mark={mark ?? undefined}
      style={{ transform: `translateY(${top}px)`, paddingLeft: 6 + row.depth * 14 }}
      onPointerDown={(event) => onPress(event, row.id)}
      onClick={() => {
        if (wasDragged.current) return;
        useProjectStore.getState().reveal(tree, row.id);
      }}
    >
      {row.hasChildren ? (
        <button
          type="button"
          tabIndex={-1}
          className={classes['fold']}
          aria-label={t(row.isFolded ? 'unfold' : 'fold', { name })}
          onClick={(event) => {
            event.stopPropagation();
            change(row.isFolded ? 'unfold' : 'fold', [setCollapsed(row.id, !row.isFolded)]);
          }}
        >
          <IconChevronRight size={13} aria-hidden="true" />
        </button>
      ) : (
        <span className={classes['fold']} />
      )}
      <FamilyTile type={node.type} family={spec?.family ?? null} size={18} />
      <span className={classes['name']}>{name}</span>
      {name !== node.type && <span className={classes['type']}>{node.type}</span>}
      {forced && <span className={classes['type']}>{t('forced', { status: forced.status })}</span>}
      {breakpoint && (
        <span
          className={classes['breakpoint']}
          data-off={areOn && breakpoint.on ? undefined : ''}
          role="img"
          aria-label={t('breakpoint')}
        />
      )}
      {row.isDraft && <span className={classes['draft']}>{t('drafts')}</span>}
    </div>
  );
}
