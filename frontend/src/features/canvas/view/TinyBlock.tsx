import type { NodeProps } from '@xyflow/react';
import { memo } from 'react';
import type { BlockNode } from '../flow';
import classes from '../Canvas.module.css';

/** A block that has a few pixels: the picture of the whole tree shows it, and this is what is pressed. */
export const TinyBlock = memo(
  function TinyBlock({ id, data, selected }: NodeProps<BlockNode>) {
    return (
      <div
        className={classes['tinyBlock']}
        data-testid={`node-${id}`}
        data-type={data.node.type}
        data-selected={selected || undefined}
      />
    );
  },
  (a, b) => a.data === b.data && a.selected === b.selected,
);
