import { useTranslation } from 'react-i18next';
import { shownTrace } from '@/store/moment/shownTrace';
import { statusesOf, type TimelineRow } from './rows';
import { timeLabel } from './span';
import classes from './timeline.module.css';

export interface TipAt {
  readonly x: number;
  readonly y: number;
  readonly row: TimelineRow;
  /** The simulated time under the pointer, in s. */
  readonly time: number;
}

const OFFSET_PX = 14;
const WIDTH_PX = 260;

/** The tip at the pointer: the status of the node at that time. */
export function Tip({ x, y, row, time }: TipAt) {
  const { t } = useTranslation(['timeline', 'run']);
  const stretch = shownTrace()
    .stretches(row.uid, time, time)
    .find((s) => s.start <= time && s.end >= time);
  const left = Math.min(x + OFFSET_PX, window.innerWidth - WIDTH_PX);
  return (
    <div className={classes['tip']} style={{ left, top: y - 44 }} role="presentation">
      <strong>{row.name}</strong>{' '}
      {stretch
        ? t('during', {
            status: statusesOf(stretch)
              .map((status) => t(`run:status.${status}`))
              .join(', '),
            from: timeLabel(stretch.start),
            length: (stretch.end - stretch.start).toFixed(2),
          })
        : t('idleAt', { time: timeLabel(Math.max(time, 0)) })}
    </div>
  );
}
