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
  /** The status that the node had during the last tick, if it is idle again. */
  readonly flash: { readonly status: NodeStatus; readonly count: number } | undefined;
}

/** A status as an icon in addition to its colour; a status of the last tick only is hollow and fades. */
export function StatusMark({ status, flash }: StatusMarkProps) {
  const isPassing = status === 'IDLE' && flash !== undefined;
  const shown = isPassing ? flash.status : status;
  if (shown === 'IDLE') return null;
  const Mark = MARKS[shown];
  return (
    <span
      key={isPassing ? flash.count : status}
      className={`${classes['mark']} ${isPassing ? classes['passing'] : ''}`}
      data-status={shown}
      aria-hidden="true"
    >
      <Mark size={11} stroke={3.2} />
    </span>
  );
}
