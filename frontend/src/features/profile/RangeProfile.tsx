import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { profileBetween } from '@/store/moment/looking';
import type { Span } from '@/store/moment/range';
import { useMoment } from '@/store/moment/store';
import type { ProfileSum } from '@/store/recording/profile';
import { FlameGraph } from './FlameGraph';
import { TimesTable } from './TimesTable';
import classes from './profile.module.css';

interface RangeProfileProps {
  readonly range: Span;
  /** Reads the sum of a part of the recording. */
  readonly between?: typeof profileBetween;
}

/** The time of each node in the marked part of the recording. */
export function RangeProfile({ range: { from, to }, between = profileBetween }: RangeProfileProps) {
  const { t } = useTranslation('profile');
  const overview = useMoment((state) => state.overview);
  const [found, setFound] = useState<ProfileSum | null>(null);
  useEffect(() => {
    let isCurrent = true;
    void between(from, to).then((sum) => isCurrent && setFound(sum));
    return () => {
      isCurrent = false;
    };
    // The overview changes when more of the recording was read.
  }, [from, to, overview, between]);
  const part = { from: from.toFixed(2), to: to.toFixed(2) };
  if (found === null) return <p className={classes['note']}>{t('range.unread', part)}</p>;
  if (found.ticks === 0) return <p className={classes['note']}>{t('range.none', part)}</p>;
  const ms = (found.tick_ms / found.ticks).toFixed(3);
  return (
    <section aria-label={t('range.title', part)} data-testid="profile-range">
      <p className={classes['note']}>
        {t('range.title', part)}: {t('ticks', { count: found.ticks, ms })}
      </p>
      <FlameGraph tree={found.tree} times={found.nodes} />
      <TimesTable tree={found.tree} times={found.nodes} wholeMs={found.tick_ms} canSample={false} />
    </section>
  );
}
