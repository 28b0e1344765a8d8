import type { TFunction } from 'i18next';
import { useDebugMarks } from '@/store/debug/marks';
import type { LiveKey } from '@/store/project/live';
import classes from './Block.module.css';

interface ForcedMarkProps {
  readonly block: LiveKey;
  readonly t: TFunction<'canvas'>;
}

/** The mark of a block on which a result is forced. */
export function ForcedMark({ block, t }: ForcedMarkProps) {
  const mark = useDebugMarks((state) => state.forced.get(block));
  if (!mark) return null;
  const kind = mark.alone ? 'alone' : mark.status === 'RUNNING' ? 'frozen' : mark.once ? 'once' : 'always';
  return (
    <span className={classes['forced']} data-status={mark.status} data-testid={`forced-${block}`}>
      {t(`forced.${kind}`, { status: mark.status })}
    </span>
  );
}
