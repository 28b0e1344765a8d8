import { Tooltip } from '@mantine/core';
import { IconAlertTriangleFilled, IconExclamationMark, IconPencil } from '@tabler/icons-react';
import { useEditorStore } from '@/store/project/editor';
import type { ShownProblem } from '@/store/project/problems';
import { useProblemText } from '@/ui/hooks/useProblemText';
import classes from './Block.module.css';

const ICONS = { error: IconExclamationMark, warning: IconAlertTriangleFilled, note: IconPencil } as const;

interface ProblemMarkProps {
  readonly problem: ShownProblem;
  /** Opens the problem with its fixes; absent in an expanded SubTree. */
  readonly onOpen?: () => void;
}

/** The mark of a block's problem, with its hint; a press shows the fixes. */
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
