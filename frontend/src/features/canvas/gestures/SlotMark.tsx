import { memo } from 'react';
import { ViewportPortal } from '@xyflow/react';
import { useEditorStore } from '@/store/project/editor';
import classes from '../Canvas.module.css';

/** The insertion mark at the place where a dragged block would be inserted. */
export const SlotMark = memo(function SlotMark() {
  const slot = useEditorStore((state) => state.slot);
  if (slot?.kind !== 'between') return null;
  const { x, y, width, height } = slot.mark;
  return (
    <ViewportPortal>
      <div
        className={classes['slot']}
        data-testid="insertion-mark"
        style={{ transform: `translate(${x}px, ${y}px)`, width, height }}
      />
    </ViewportPortal>
  );
});
