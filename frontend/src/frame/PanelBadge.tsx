import { countProblems } from '@/store/problems/list';
import { useProblems } from '@/store/problems/useProblems';
import classes from './frame.module.css';

interface PanelBadgeProps {
  readonly panel: string;
}

/** The number of problems, on the tab of the Problems panel. */
export function PanelBadge({ panel }: PanelBadgeProps) {
  return panel === 'problems' ? <ProblemsBadge /> : null;
}

function ProblemsBadge() {
  const { errors, warnings } = countProblems(useProblems());
  if (errors + warnings === 0) return null;
  return (
    <span
      className={classes['badge']}
      data-severity={errors > 0 ? 'error' : 'warning'}
      // The number is no text, so that the tab keeps the name of its panel. The status bar states it as text.
      data-count={errors > 0 ? errors : warnings}
    />
  );
}
