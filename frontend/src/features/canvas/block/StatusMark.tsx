import { IconCheck, IconPlayerPlayFilled, IconPlayerSkipForwardFilled, IconX } from '@tabler/icons-react';
import type { NodeStatus } from '@/generated/messages';
import classes from './Block.module.css';

const MARKS = {
  RUNNING: IconPlayerPlayFilled,
  SUCCESS: IconCheck,
  FAILURE: IconX,
  SKIPPED: IconPlayerSkipForwardFilled,
} as const;

/** A status told by an icon besides its colour. */
export function StatusMark({ status }: { readonly status: NodeStatus }) {
  if (status === 'IDLE') return null;
  const Mark = MARKS[status];
  return (
    <span className={classes['mark']} aria-hidden="true">
      <Mark size={11} stroke={3.2} />
    </span>
  );
}
