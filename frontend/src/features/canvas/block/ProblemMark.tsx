import { Tooltip } from '@mantine/core';
import { IconAlertTriangleFilled, IconExclamationMark, IconPencil } from '@tabler/icons-react';
import type { ShownProblem } from '@/store/project/problems';
import { useProblemText } from '@/ui/useProblemText';
import classes from './Block.module.css';

const ICONS = { error: IconExclamationMark, warning: IconAlertTriangleFilled, note: IconPencil } as const;

/** What is wrong with a block, and what to do, where the eye is. */
export function ProblemMark({ problem }: { readonly problem: ShownProblem }) {
  const text = useProblemText()(problem);
  const Mark = ICONS[problem.severity];
  return (
    <Tooltip
      multiline
      maw={320}
      openDelay={100}
      label={
        <>
          <strong>{text.message}</strong>
          {text.hint && <div>{text.hint}</div>}
        </>
      }
    >
      <span
        className={classes['problem']}
        data-severity={problem.severity}
        role="img"
        aria-label={`${text.message} ${text.hint}`}
      >
        <Mark size={12} stroke={3} aria-hidden="true" />
      </span>
    </Tooltip>
  );
}
