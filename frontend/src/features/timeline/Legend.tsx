import { useTranslation } from 'react-i18next';
import classes from './timeline.module.css';

const SHOWN = ['RUNNING', 'SUCCESS', 'FAILURE', 'SKIPPED'] as const;

export function Legend() {
  const { t } = useTranslation('run');
  return (
    <span className={classes['legend']}>
      {SHOWN.map((status) => (
        <span key={status} className={classes['legendItem']}>
          <span className={classes['swatch']} data-status={status} aria-hidden="true" />
          {t(`status.${status}`)}
        </span>
      ))}
    </span>
  );
}
