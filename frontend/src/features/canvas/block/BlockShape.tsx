import { memo, useId } from 'react';
import type { Family } from '@/model/vocabulary';
import { outline } from '@/ui/shapes';
import classes from './Block.module.css';

interface BlockShapeProps {
  readonly family: Family | null;
  readonly width: number;
  readonly height: number;
}

const TILE = 44;

/** The shape of a block: the outline of its family, the coloured side, the ring and the halo. */
export const BlockShape = memo(function BlockShape({ family, width, height }: BlockShapeProps) {
  const clip = useId();
  const path = outline(family, width, height);
  return (
    <svg className={classes['shape']} width={width} height={height} aria-hidden="true">
      <clipPath id={clip}>
        <path d={path} />
      </clipPath>
      {family === 'subtree' && <path className={classes['stack']} d={path} transform="translate(4 4)" />}
      <path className={classes['halo']} d={path} />
      <path className={classes['fill']} d={path} />
      <rect className={classes['side']} width={TILE} height={height} clipPath={`url(#${clip})`} />
      <path className={classes['ring']} d={path} />
      <path className={classes['flash']} d={path} />
    </svg>
  );
});
