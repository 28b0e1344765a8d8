import { useTranslation } from 'react-i18next';
import { progress, type Study } from '@/model/evaluation/study';
import { short } from '../outcomeText';
import classes from './study.module.css';

const WIDTH = 240;
const HEIGHT = 96;
const EDGE = 5;

interface Dot {
  readonly x: number;
  readonly y: number;
}

/** The picture of a study: the rating of each trial with the best one so far, and the rating by each port. */
export function StudyPicture({ study }: { readonly study: Study }) {
  const { t } = useTranslation('evaluate');
  const { objective } = study;
  const steps = progress(study);
  if (steps.length === 0) return <p>{t('study.unrated')}</p>;
  const rated = study.trials.flatMap(({ values, rating }) => (rating === null ? [] : [{ values, rating }]));
  return (
    <div className={classes['pictures']}>
      <Plot
        title={t('study.byTrial', { objective })}
        dots={steps.map(({ number, rating }) => ({ x: number + 1, y: rating }))}
        line={steps.map(({ number, best }) => ({ x: number + 1, y: best }))}
        from={1}
        to={Math.max(2, study.trials.length)}
      />
      {study.ports.map(({ address, low, high }) => (
        <Plot
          key={address}
          title={address}
          dots={rated.map(({ values, rating }) => ({ x: values[address] ?? low, y: rating }))}
          from={low}
          to={high}
        />
      ))}
    </div>
  );
}

interface PlotProps {
  readonly title: string;
  readonly dots: readonly Dot[];
  readonly line?: readonly Dot[];
  readonly from: number;
  readonly to: number;
}

function Plot({ title, dots, line = [], from, to }: PlotProps) {
  const { t } = useTranslation('evaluate');
  const low = dots.reduce((least, { y }) => Math.min(least, y), Infinity);
  const high = dots.reduce((most, { y }) => Math.max(most, y), -Infinity);
  const x = (value: number) => EDGE + ((value - from) / (to - from)) * (WIDTH - 2 * EDGE);
  const share = (value: number) => (high > low ? (value - low) / (high - low) : 0.5);
  const y = (value: number) => HEIGHT - EDGE - share(value) * (HEIGHT - 2 * EDGE);
  const facts = { low: short(low), high: short(high), from: short(from), to: short(to) };
  return (
    <figure className={classes['picture']}>
      <figcaption>{title}</figcaption>
      <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label={t('study.plot', { title, ...facts })}>
        {line.length > 1 ? (
          <polyline
            className={classes['best']}
            points={line.map((dot) => `${x(dot.x)},${y(dot.y)}`).join(' ')}
          />
        ) : null}
        {dots.map((dot, index) => (
          <circle key={index} className={classes['dot']} cx={x(dot.x)} cy={y(dot.y)} r={3} />
        ))}
      </svg>
      <small className={classes['muted']}>{t('study.facts', facts)}</small>
    </figure>
  );
}
