import { useStore } from '@xyflow/react';
import { useCallback, useMemo, useRef, useState, type DragEvent, type MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import type { ChangeKind } from '@/model/difference/changes';
import { childrenOf, type NodeId } from '@/model/diagram';
import { nestTree } from '@/model/nested';
import { setEditor } from '@/store/project/editor';
import { factsOf, type FactsInput } from './facts';
import { frameOf, partAt } from './frame';
import { PartBox } from './PartBox';
import { Tip } from './Tip';
import { usePainted } from './usePainted';
import { usePinch } from './usePinch';
import classes from './WholeTree.module.css';

interface WholeTreeProps extends FactsInput {
  /** The blocks that differ, in a comparison. */
  readonly marks: ReadonlyMap<NodeId, ChangeKind>;
  /** The blocks that a search has found. */
  readonly hits: ReadonlySet<NodeId>;
  readonly onEnter: (id: NodeId) => void;
  readonly onMenu?: (event: MouseEvent, id: NodeId) => void;
}

interface Point {
  readonly clientX: number;
  readonly clientY: number;
}

/** So long, in ms, a dragged block waits over a part until it opens. */
const OPENS_AFTER_MS = 700;

/**
 * The whole of a large tree in one view: nested boxes with the names of its upper levels, and all that is deeper as
 * pieces with a cell for each block. A press on any of them goes there.
 */
export function WholeTree(props: WholeTreeProps) {
  const { diagram, inside, vocabulary, problems, selection, marks, hits, onEnter, onMenu } = props;
  const { t } = useTranslation('canvas');
  const root = useRef<HTMLDivElement>(null);
  const picture = useRef<HTMLCanvasElement>(null);
  const [pointed, setPointed] = useState<NodeId | null>(null);
  const waiting = useRef<{ readonly id: NodeId | null; readonly since: number }>({ id: null, since: 0 });
  const width = useStore((state) => state.width);
  const height = useStore((state) => state.height);
  const frame = useMemo(() => frameOf(width, height), [width, height]);
  const parts = useMemo(() => nestTree(diagram, frame), [diagram, frame]);
  const facts = useMemo(
    () => factsOf({ diagram, inside, vocabulary, problems, selection }),
    [diagram, inside, vocabulary, problems, selection],
  );
  usePainted(root, picture, { parts, facts, marks, hits }, frame);

  const idAt = useCallback(
    ({ clientX, clientY }: Point): NodeId | null => {
      const box = root.current?.getBoundingClientRect();
      return box ? partAt(parts, clientX - box.left, clientY - box.top) : null;
    },
    [parts],
  );
  const enterAt = useCallback(
    (point: Point) => {
      const id = idAt(point);
      if (id !== null) onEnter(id);
    },
    [idAt, onEnter],
  );
  usePinch(root, enterAt);

  const onDragOver = (event: DragEvent) => {
    // A block has no place among the boxes; the part under it opens, as a folder does.
    event.stopPropagation();
    setEditor({ slot: null });
    const id = idAt(event);
    if (id !== waiting.current.id) waiting.current = { id, since: event.timeStamp };
    else if (id !== null && event.timeStamp - waiting.current.since > OPENS_AFTER_MS) onEnter(id);
  };

  const pointedAt = facts.get(pointed ?? '');
  return (
    <div className={classes['whole']} data-testid="whole-tree">
      <p className={classes['hint']} role="status">
        {t('whole.hint', { count: facts.size })}
      </p>
      {/* The canvas around has the focus: its keys walk the blocks and go to the selected one. */}
      {/* eslint-disable-next-line jsx-a11y/interactive-supports-focus, jsx-a11y/click-events-have-key-events */}
      <div
        ref={root}
        role="tree"
        aria-label={t('whole.label', { tree: diagram.id })}
        className={classes['frame']}
        style={{ left: frame.x, top: frame.y, width: frame.width, height: frame.height }}
        data-searched={hits.size > 0 || undefined}
        onClick={enterAt}
        onContextMenu={(event) => {
          const id = idAt(event);
          if (id !== null) onMenu?.(event, id);
        }}
        onPointerMove={(event) => setPointed(idAt(event))}
        onPointerLeave={() => setPointed(null)}
        onDragOver={onDragOver}
        onDrop={(event) => event.stopPropagation()}
      >
        {parts.map((part) => {
          const fact = facts.get(part.id);
          if (!fact) return null;
          const { id } = part;
          return (
            <PartBox
              key={id}
              part={part}
              fact={fact}
              facts={facts}
              mark={marks.get(id)}
              hits={hits}
              isLeaf={childrenOf(diagram, id).length === 0}
            />
          );
        })}
        <canvas ref={picture} className={classes['cells']} aria-hidden="true" />
        {pointedAt && <Tip fact={pointedAt} parts={parts} room={frame} />}
      </div>
    </div>
  );
}
