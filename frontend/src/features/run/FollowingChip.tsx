import { IconX } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useIsBack } from '@/store/moment/store';
import { hasApplication } from '@/store/run/commands';
import { useSessionStore } from '@/store/session/store';
import { toggleFollowing, useFollowing } from './following';
import classes from './following.module.css';

/** Says on the canvas that its view follows the running block, while there is a program to follow; ends that. */
export function FollowingChip() {
  const { t } = useTranslation('run');
  const isOn = useFollowing((state) => state.isOn);
  const runs = useSessionStore(({ connection }) => connection === 'open' && hasApplication());
  const isBack = useIsBack();
  if (!isOn || !runs || isBack) return null;
  return (
    <button
      type="button"
      className={classes['chip']}
      onClick={toggleFollowing}
      title={t('following.end')}
      aria-label={t('following.end')}
      data-testid="following"
    >
      {t('following.on')} <IconX size={12} aria-hidden="true" />
    </button>
  );
}
