import { Tooltip } from '@mantine/core';
import { IconAlertTriangleFilled, IconExclamationMark, IconPencil } from '@tabler/icons-react';
import { useEditorStore } from '@/store/project/editor';
import type { ShownProblem } from '@/store/project/problems';
import { useProblemText } from '@/ui/useProblemText';
import classes from './Block.module.css';

const ICONS = { error: IconExclamationMark, warning: IconAlertTriangleFilled, note: IconPencil } as const;

interface ProblemMarkProps {
  readonly problem: ShownProblem;
  /** Shows it in full with what mends it; absent in a tree that is only looked into. */
  readonly onOpen?: () => void;
}

/** What is wrong with a block, and what to do, where the eye is; a press offers what mends it. */
export function ProblemMark({ problem, onOpen }: ProblemMarkProps) {
  const text = useProblemText()(problem);
  const isOpen = useEditorStore((state) => state.fixing !== null);
  const Mark = ICONS[problem.severity];
  const shared = {
    className: `${classes['problem']} nodrag`,
    'data-severity': problem.severity,
    'aria-label': `${text.message} ${text.hint}`,
  };
  const icon = <Mark size={12} stroke={3} aria-hidden="true" />;
  return (
    <Tooltip
      multiline
      maw={320}
      openDelay={100}
      disabled={isOpen}
      label={
        <>
          <strong>{text.message}</strong>
          {text.hint && <div>{text.hint}</div>}
        </>
      }
    >
      {onOpen ? (
        <button
          type="button"
          tabIndex={-1}
          {...shared}
          aria-haspopup="dialog"
          data-testid="problem-mark"
          onClick={onOpen}
        >
          {icon}
        </button>
      ) : (
        <span role="img" {...shared}>
          {icon}
        </span>
      )}
    </Tooltip>
  );
}
