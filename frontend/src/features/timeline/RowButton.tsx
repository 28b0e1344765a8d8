import { memo, useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { NodeStatus } from '@/generated/messages';
import { shownTrace, useShownTrace } from '@/store/moment/shownTrace';
import type { TimelineRow } from './rows';
import classes from './timeline.module.css';

const SUMMARY_EVERY_MS = 1000;

interface RowButtonProps {
  readonly row: TimelineRow;
  readonly index: number;
  readonly top: number;
  readonly isTabStop: boolean;
  readonly onSelect: (row: TimelineRow) => void;
  readonly onFocus: (index: number) => void;
}

/** The row of a node: its name, and its statuses as text for users who cannot see the strip. */
export const RowButton = memo(function RowButton(props: RowButtonProps) {
  const { row, index, top, isTabStop, onSelect, onFocus } = props;
  const { t } = useTranslation(['timeline', 'run']);
  const { status, seconds, times } = useSummary(row.uid);
  const summary = t('summary', {
    name: row.name,
    type: row.type,
    status: t(`run:status.${status}`),
    seconds: seconds.toFixed(1),
    count: times,
  });
  return (
    <button
      type="button"
      className={classes['row']}
      style={{ transform: `translateY(${top}px)`, paddingLeft: 10 + Math.min(row.depth, 8) * 12 }}
      tabIndex={isTabStop ? 0 : -1}
      data-index={index}
      data-status={status}
      data-node={row.node}
      aria-label={summary}
      onClick={() => onSelect(row)}
      onFocus={() => onFocus(index)}
    >
      <span className={classes['name']}>{row.name}</span>
    </button>
  );
});

interface Summary {
  readonly status: NodeStatus;
  readonly seconds: number;
  readonly times: number;
}

/** Returns the current and past statuses of a node, updated once a second. */
function useSummary(uid: number): Summary {
  const recorded = useShownTrace((state) => state.recorded);
  const [summary, setSummary] = useState(() => summaryOf(uid));
  useEffect(() => {
    const update = () => {
      const next = summaryOf(uid);
      setSummary((old) =>
        old.status === next.status && old.times === next.times && Math.abs(old.seconds - next.seconds) < 0.1
          ? old
          : next,
      );
    };
    update();
    const timer = setInterval(update, SUMMARY_EVERY_MS);
    return () => clearInterval(timer);
  }, [uid, recorded]);
  return summary;
}

function summaryOf(uid: number): Summary {
  const trace = shownTrace();
  return { status: trace.status(uid), ...trace.runningOf(uid) };
}
