import { IconBulb, IconX } from '@tabler/icons-react';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { openPalette } from '@/commands/palette';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { useGuide } from './guide/guide';
import { finishHint, HINTS, useHints } from './hints';
import classes from './onboarding.module.css';

/** A hint for new users in the status bar, one at a time. */
export function Hint() {
  const { t } = useTranslation('onboarding');
  const id = useHints(({ done }) => HINTS.find((each) => !done.includes(each)));
  const hasEdited = useProjectStore((state) =>
    Object.values(state.histories).some((each) => each.past.length > 0),
  );
  const isRunning = useSessionStore((state) => state.executor === 'application_running');
  const isGuided = useGuide(({ step }) => step !== null);
  const isReadOnly = useProjectStore((state) => state.role === 'viewer');

  useEffect(() => {
    if (hasEdited) finishHint('build');
  }, [hasEdited]);
  useEffect(() => {
    if (isRunning) finishHint('run');
  }, [isRunning]);

  // The guided first task gives the same advice, at the place where it applies.
  if (id === undefined || isReadOnly || isGuided) return null;
  return (
    <span className={classes['hint']} role="status" data-testid="hint" data-hint={id}>
      <IconBulb size={14} aria-hidden="true" />
      {id === 'find' ? (
        <button
          type="button"
          className={classes['hintText']}
          onClick={() => {
            finishHint('find');
            openPalette();
          }}
        >
          {t('hint.find')}
        </button>
      ) : (
        <span className={classes['hintText']}>{t(`hint.${id}`)}</span>
      )}
      <button
        type="button"
        className={classes['hintClose']}
        aria-label={t('hint.close')}
        title={t('hint.close')}
        onClick={() => {
          finishHint(id);
        }}
      >
        <IconX size={13} aria-hidden="true" />
      </button>
    </span>
  );
}
