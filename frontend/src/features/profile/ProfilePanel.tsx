import { ScrollArea, Switch } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { measure, useProfile } from '@/store/debug/profile';
import { markedRange, useRange } from '@/store/moment/range';
import { useSessionStore } from '@/store/session/store';
import { FlameGraph } from './FlameGraph';
import { RangeProfile } from './RangeProfile';
import { Stacks } from './Stacks';
import { TimesTable } from './TimesTable';
import classes from './profile.module.css';

/** The time of each node of the run: switched on and off, as a flame graph and as a table. */
export function ProfilePanel() {
  const { t } = useTranslation('profile');
  const tree = useSessionStore((state) => state.tree);
  const profile = useSessionStore((state) => state.profile);
  const role = useSessionStore(({ introspection }) => introspection?.role);
  const isWanted = useProfile((state) => state.isWanted);
  const isDriver = role === 'driver';
  const a = useRange((state) => state.a);
  const b = useRange((state) => state.b);
  const range = markedRange({ a, b });
  return (
    <ScrollArea h="100%" type="auto" data-testid="profile">
      <div className={classes['panel']}>
        <Switch
          size="md"
          label={t('measure')}
          checked={isWanted || (profile?.on ?? false)}
          disabled={!isDriver}
          data-testid="profile-on"
          onChange={({ currentTarget: { checked } }) => void measure(checked)}
        />
        {role === undefined && <p className={classes['note']}>{t('noRun')}</p>}
        {role === 'viewer' && <p className={classes['note']}>{t('ofViewer')}</p>}
        {role !== undefined && !profile && <p className={classes['note']}>{t('none')}</p>}
        {range && <RangeProfile range={range} />}
        {profile && profile.ticks > 0 && !range && (
          <>
            <p className={classes['note']} data-testid="profile-ticks">
              {t('ticks', { count: profile.ticks, ms: (profile.tick_ms / profile.ticks).toFixed(3) })}
            </p>
            <FlameGraph tree={tree} times={profile.nodes} />
            <TimesTable
              tree={tree}
              times={profile.nodes}
              wholeMs={profile.tick_ms}
              canSample={isDriver && profile.on}
            />
            {profile.sample !== null && (
              <Stacks
                name={tree[profile.sample - 1]?.name ?? ''}
                samples={profile.samples}
                stacks={profile.stacks}
              />
            )}
          </>
        )}
      </div>
    </ScrollArea>
  );
}
