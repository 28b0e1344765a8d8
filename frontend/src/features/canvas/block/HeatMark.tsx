import type { TFunction } from 'i18next';
import { useProfile } from '@/store/debug/profile';
import type { LiveKey } from '@/store/project/live';
import classes from './Block.module.css';

interface HeatMarkProps {
  readonly block: LiveKey;
  readonly t: TFunction<'canvas'>;
}

/** The share of a block in the time of all ticks, while nodes are measured. */
export function HeatMark({ block, t }: HeatMarkProps) {
  const share = useProfile((state) => state.heat.get(block));
  if (share === undefined) return null;
  const percent = Math.round(share * 100);
  return (
    <span
      className={classes['heat']}
      style={{ ['--heat' as string]: share }}
      title={t('heat', { percent })}
      data-testid={`heat-${block}`}
    >
      {percent} %
    </span>
  );
}
