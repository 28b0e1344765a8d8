import { IconCheck, IconPlayerPlayFilled, IconPlayerSkipForwardFilled, IconX } from '@tabler/icons-react';
import type { NodeStatus } from '@/generated/messages';
import classes from './Block.module.css';

const MARKS = {
  RUNNING: IconPlayerPlayFilled,
  SUCCESS: IconCheck,
  FAILURE: IconX,
  SKIPPED: IconPlayerSkipForwardFilled,
} as const;

interface StatusMarkProps {
  readonly status: NodeStatus;
  /** The status in the last tick, which stays until the next one. */
  readonly past: NodeStatus | undefined;
  /** The status that the node had only within the last tick, if it is idle again. */
  readonly flash: { readonly status: NodeStatus; readonly count: number } | undefined;
}

/**
 * A status as an icon in addition to the colour. The icon is hollow for a status of the last tick only; it
 * fades for an earlier status that the next tick did not repeat.
 */
export function StatusMark({ status, past, flash }: StatusMarkProps) {
  const isPast = status === 'IDLE' && past !== undefined;
  const isPassing = status === 'IDLE' && !isPast && flash !== undefined;
  const shown = isPast ? past : isPassing ? flash.status : status;
  if (shown === 'IDLE') return null;
  const Mark = MARKS[shown];
  return (
    <span
      key={isPassing ? flash.count : shown}
      className={`${classes['mark']} ${isPast ? classes['past'] : ''} ${isPassing ? classes['passing'] : ''}`}
      data-status={shown}
      aria-hidden="true"
    >
      <Mark size={11} stroke={3.2} />
    </span>
  );
}
