import { useTimeout } from '@mantine/hooks';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import classes from '../viewer.module.css';

/** A hint before this time would only flicker on a fast computer. */
const LATE_MS = 300;

/** The hint over a 3D view that has not drawn its first picture yet. */
export function Loading3d() {
  const { t } = useTranslation('viewer');
  const [isLate, setLate] = useState(false);
  useTimeout(() => setLate(true), LATE_MS, { autoInvoke: true });
  // Screen readers announce a text only if its region was there before.
  return (
    <div className={classes['loading']} data-late={isLate || undefined} role="status">
      {isLate ? <p>{t('loading3d')}</p> : null}
    </div>
  );
}
