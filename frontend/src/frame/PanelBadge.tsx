import { countProblems } from '@/store/problems/list';
import { useProblems } from '@/store/problems/useProblems';
import classes from './frame.module.css';

interface PanelBadgeProps {
  readonly panel: string;
}

/** The number of problems, on the tab of their panel. */
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
      // Not as text: the name of the tab is that of its panel. The status bar says the number.
      data-count={errors > 0 ? errors : warnings}
    />
  );
}
