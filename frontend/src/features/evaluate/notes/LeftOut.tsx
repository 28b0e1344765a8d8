import { useTranslation } from 'react-i18next';
import { reasonText } from '@/i18n/evaluationReasons';
import classes from '../evaluate.module.css';

/** The launch nodes that an evaluation runs without, each with its place. */
export function LeftOut({ notes }: { readonly notes: string }) {
  const { t } = useTranslation('evaluate');
  const lines = notes.split('\n').filter((line) => line !== '');
  if (lines.length === 0) return null;
  return (
    <details role="note" className={classes['muted']}>
      <summary className={classes['summary']}>{t('leftOut', { count: lines.length })}</summary>
      <ul className={classes['plain']}>
        {lines.map((line) => (
          <li key={line}>{reasonText(t, line)}</li>
        ))}
      </ul>
    </details>
  );
}
