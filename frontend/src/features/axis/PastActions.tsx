import { useTranslation } from 'react-i18next';
import { canCompare } from '@/store/moment/compare/comparing';
import { extent } from '@/store/moment/looking';
import { mayGoBack } from '@/store/moment/rerun/goBack';
import { useSource } from '@/store/moment/source';
import { useIsBack, useMoment } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';
import { CommandButton } from '@/ui/CommandButton';
import classes from './axis.module.css';

/**
 * What can be done with the shown run: try many values, compare, keep. While the present is shown they keep
 * their place, so that the strip does not move below the pointer that takes it to the past.
 */
export function PastActions() {
  const { t } = useTranslation('axis');
  const isBack = useIsBack();
  const isKept = useSource(({ kept }) => kept !== null);
  // What `canCompare` asks for.
  useMoment((state) => state.t === null);
  const isExact = useSessionStore(({ liveRuns }) => mayGoBack() && !liveRuns.includes(extent()?.run ?? ''));
  const isCompared = useSessionStore(canCompare);
  const isAttached = useSessionStore(({ attached }) => attached !== null);
  return (
    <div className={classes['pastActions']} style={isBack ? undefined : { visibility: 'hidden' }}>
      {isExact && !isKept ? <CommandButton command="time.tryMany" size={26} testId="axis-try-many" /> : null}
      {isCompared ? <CommandButton command="time.compare" size={26} testId="axis-compare" /> : null}
      {isKept || isAttached ? null : (
        <CommandButton command="run.kept" label={t('keep')} size={26} testId="axis-keep" />
      )}
    </div>
  );
}
