import { useTranslation } from 'react-i18next';
import type { SampledStack } from '@/generated/messages';
import classes from './profile.module.css';

const MOST_ROWS = 20;

interface StacksProps {
  readonly name: string;
  readonly samples: number;
  readonly stacks: readonly SampledStack[];
}

/** The stacks that were seen in a sampled leaf, the most frequent first. */
export function Stacks({ name, samples, stacks }: StacksProps) {
  const { t } = useTranslation('profile');
  return (
    <section aria-label={t('stacks', { name })} data-testid="stacks">
      <h2>{t('stacks', { name })}</h2>
      <p className={classes['note']}>{t('samples', { count: samples })}</p>
      <ol className={classes['stacks']}>
        {stacks.slice(0, MOST_ROWS).map((stack) => (
          <li key={stack.frames.join('\n')}>
            <strong>{Math.round((stack.samples / Math.max(1, samples)) * 100)} %</strong>{' '}
            <code>{stack.frames.join(' › ')}</code>
          </li>
        ))}
      </ol>
    </section>
  );
}
