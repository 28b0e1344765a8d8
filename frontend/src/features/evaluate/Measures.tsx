import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import type { Outcome } from '@/api/evaluations';
import { binsOf, measuresOf, type Bins } from './bins';
import classes from './evaluate.module.css';
import { short } from './outcomeText';

const HEIGHT = 44;
const WIDTH = 200;

/** The distribution of each measure: successes below, the others on top of them. */
export function Measures({ rows }: { readonly rows: ReadonlyMap<number, Outcome> }) {
  const { t } = useTranslation('evaluate');
  const shown = useMemo(() => {
    const outcomes = [...rows.values()];
    return measuresOf(outcomes).flatMap((name) => {
      const bins = binsOf(outcomes, name);
      return bins ? [{ name, bins }] : [];
    });
  }, [rows]);
  if (shown.length === 0) return null;
  return (
    <section aria-label={t('measures.title')} className={classes['measures']}>
      {shown.map(({ name, bins }) => (
        <figure key={name} className={classes['measure']}>
          <figcaption>{name}</figcaption>
          <Plot bins={bins} label={t('measures.plot', values(bins))} />
          <small className={classes['muted']}>{t('measures.facts', values(bins))}</small>
        </figure>
      ))}
    </section>
  );
}

const values = ({ from, to, median, count }: Bins) => ({
  from: short(from),
  to: short(to),
  median: short(median),
  count,
});

function Plot({ bins: { bins }, label }: { readonly bins: Bins; readonly label: string }) {
  const most = Math.max(...bins.map(({ successes, others }) => successes + others));
  const width = WIDTH / bins.length;
  return (
    <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label={label} preserveAspectRatio="none">
      {bins.map(({ successes, others }, index) => {
        const low = (successes / most) * HEIGHT;
        const top = (others / most) * HEIGHT;
        return (
          <g key={index}>
            <rect
              className={classes['good']}
              x={index * width}
              y={HEIGHT - low}
              width={width - 1}
              height={low}
            />
            <rect
              className={classes['bad']}
              x={index * width}
              y={HEIGHT - low - top}
              width={width - 1}
              height={top}
            />
          </g>
        );
      })}
    </svg>
  );
}
