import { Progress } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { Evaluation, EvaluationSide } from '@/api/evaluations';
import classes from './evaluate.module.css';
import { duration, percent } from './outcomeText';
import { isLive } from './useEvaluations';

/** The outcomes that count in the rate: the others say nothing of the project. */
const COUNTED = ['success', 'failure', 'error', 'crashed', 'timeout'];

interface Props {
  readonly evaluation: Evaluation;
  readonly side: EvaluationSide;
}

/** The rate of success with its interval, how far the evaluation is, and how often each outcome occurs. */
export function RateBar({ evaluation, side }: Props) {
  const { t } = useTranslation('evaluate');
  const { done, wanted, rate, low, high, counts } = side;
  const counted = COUNTED.reduce((sum, outcome) => sum + (counts[outcome] ?? 0), 0);
  const others = Object.entries(counts).filter(([outcome]) => outcome !== 'success');
  return (
    <div className={classes['rate']}>
      {done > 0 ? (
        <p className={classes['number']} data-testid="evaluation-rate">
          <strong>{percent(rate)}</strong>{' '}
          {t('rate.words', { count: counted, successes: counts['success'] ?? 0, low: percent(low) })}{' '}
          <span className={classes['muted']}>
            {t(evaluation.sequential ? 'rate.sequence' : 'rate.interval', {
              low: percent(low),
              high: percent(high),
            })}
          </span>
        </p>
      ) : null}
      {done > 0 ? (
        <div className={classes['interval']} aria-hidden="true">
          <span style={{ left: `${low * 100}%`, width: `${Math.max((high - low) * 100, 0.5)}%` }} />
          <i style={{ left: `${rate * 100}%` }} />
        </div>
      ) : null}
      {isLive(evaluation) ? (
        // Stripes that move would repaint the page all the time, on the processor that the runs need.
        <Progress size="sm" value={wanted ? (done / wanted) * 100 : 0} aria-label={t('progress.label')} />
      ) : null}
      <p className={classes['muted']} role="status">
        {t('progress.done', { done, wanted: wanted ?? '…' })}
        {isLive(evaluation) && evaluation.left_s !== null
          ? ` · ${t('progress.left', { left: duration(evaluation.left_s) })}`
          : ''}
        {evaluation.waits_for ? ` · ${t(`waits.${evaluation.waits_for}`)}` : ''}
        {others.map(([outcome, count]) => ` · ${count} ${t(`outcome.${outcome}` as 'outcome.failure')}`)}
      </p>
    </div>
  );
}
