import { Button } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { Video } from './pictures/VideoPanel';
import classes from './viewer.module.css';

interface VideoInsteadProps {
  /** The rate at which 3D was drawn, in Hz. */
  readonly hz: number;
  readonly onBack: () => void;
}

/** The world as video, shown where 3D is too slow, with the reason and a button back to 3D. */
export function VideoInstead({ hz, onBack }: VideoInsteadProps) {
  const { t } = useTranslation('viewer');
  return (
    <div className={classes['instead']} data-testid="video-instead">
      <div className={classes['insteadNote']} role="status">
        <span>{t('slow3d', { hz: hz.toFixed(hz < 1 ? 1 : 0) })}</span>
        <Button size="compact-xs" variant="light" onClick={onBack}>
          {t('backTo3d')}
        </Button>
      </div>
      <Video />
    </div>
  );
}
