import { useProjectStore } from '@/store/project';
import classes from './frame.module.css';

interface PanelBadgeProps {
  readonly panel: string;
}

/** The number of problems, on the tab of their panel. */
export function PanelBadge({ panel }: PanelBadgeProps) {
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const errors = diagnostics.filter((item) => item.severity === 'error').length;
  const warnings = diagnostics.filter((item) => item.severity === 'warning').length;
  if (panel !== 'problems' || errors + warnings === 0) return null;
  return (
    <span className={classes['badge']} data-severity={errors > 0 ? 'error' : 'warning'}>
      {errors > 0 ? errors : warnings}
    </span>
  );
}
