import { IconPlugConnected, IconPlugConnectedX } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useMoment } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';
import classes from '../frame.module.css';

const SHOWN_MS = 500;

/** The status bar of a page that follows a program: its address, and the age of its last status. */
export function AttachedStatus({ address }: { readonly address: string }) {
  const { t } = useTranslation('attached');
  const { t: ofFrame } = useTranslation('frame');
  const connection = useSessionStore((state) => state.connection);
  const attached = useSessionStore((state) => state.attached);
  const simTime = useSessionStore((state) => state.simTime);
  const past = useMoment((state) => state.shown);
  const ageS = useAge();
  const isFollowing = connection === 'open' && attached?.state === 'following';
  const Icon = isFollowing ? IconPlugConnected : IconPlugConnectedX;
  const time = past?.t ?? simTime;
  return (
    <footer className={classes['statusBar']} aria-label={ofFrame('status.label')}>
      <span className={classes['statusItem']} data-connection={isFollowing ? 'open' : 'lost'}>
        <Icon size={14} aria-hidden="true" />
        {address} ·{' '}
        {connection === 'open'
          ? t(`state.${attached?.state ?? 'connecting'}`)
          : ofFrame(`connection.${connection}`)}
      </span>
      <span className={classes['statusItem']} data-testid="attached-age" data-age={ageS?.toFixed(2)}>
        {ageS === null ? t('never') : t('age', { age: `${ageS.toFixed(1)} s` })}
      </span>
      {attached && attached.dropped > 0 ? (
        <span className={classes['statusItem']}>{t('dropped', { count: attached.dropped })}</span>
      ) : null}
      <span className={classes['spacer']} />
      <span className={classes['sim']} data-testid="attached-time" data-t={time.toFixed(3)}>
        {time.toFixed(1)} s
      </span>
    </footer>
  );
}

/** Returns the seconds since the last status, which each look at the program brings; null before the first. */
function useAge(): number | null {
  const [ageS, setAgeS] = useState<number | null>(null);
  useEffect(() => {
    let lastMs: number | null = null;
    const unfollow = useSessionStore.subscribe((now, before) => {
      if (now.tick !== before.tick) lastMs = performance.now();
    });
    const timer = setInterval(() => {
      const told = useSessionStore.getState().attached?.age_s ?? null;
      const seen = lastMs === null ? null : (performance.now() - lastMs) / 1000;
      setAgeS(seen ?? told);
    }, SHOWN_MS);
    return () => {
      unfollow();
      clearInterval(timer);
    };
  }, []);
  return ageS;
}
