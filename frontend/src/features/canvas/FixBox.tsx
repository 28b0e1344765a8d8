import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { NodeProblems } from '@/features/inspector/NodeProblems';
import { displayName, type Diagram, type NodeId } from '@/model/diagram';
import { pointOf } from './quickAdd/open';
import classes from './Canvas.module.css';

interface FixBoxProps {
  readonly diagram: Diagram;
  readonly id: NodeId;
  /** Called when the box closes; must return the focus to the canvas. */
  readonly onClose: () => void;
}

const WIDTH = 320;
const HEIGHT = 240;

/** A box below a block with its problems and their fixes; opened with the pointer or the keyboard. */
export function FixBox({ diagram, id, onClose }: FixBoxProps) {
  const { t } = useTranslation('canvas');
  const box = useRef<HTMLDivElement>(null);
  const node = diagram.nodes[id];
  useEffect(() => {
    const first = box.current?.querySelector('button') ?? box.current;
    first?.focus({ preventScroll: true });
  }, [id]);
  if (!node) return null;
  const { x, y } = pointOf(id);
  const left = Math.max(8, Math.min(x, window.innerWidth - WIDTH - 8));
  const top = Math.max(8, Math.min(y, window.innerHeight - HEIGHT - 8));
  return (
    // Escape, and a focus that leaves, close the box, like every box on the canvas.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions
    <div
      ref={box}
      className={classes['fixBox']}
      style={{ left, top, width: WIDTH, maxHeight: HEIGHT }}
      role="dialog"
      aria-label={t('fixes', { name: displayName(node) })}
      data-testid="fix-box"
      tabIndex={-1}
      onKeyDown={(event) => {
        event.stopPropagation();
        if (event.key === 'Escape') onClose();
      }}
      onBlur={(event) => {
        if (!event.currentTarget.contains(event.relatedTarget)) onClose();
      }}
    >
      <NodeProblems diagram={diagram} id={id} onFixed={onClose} />
    </div>
  );
}
