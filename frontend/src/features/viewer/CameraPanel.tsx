import { useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { PicturePanel } from './PicturePanel';
import { useStream } from './useStream';
import { useVisible } from '@/ui/useVisible';
import classes from './viewer.module.css';

const CAMERA_HZ = 15;

/** The picture of the robot's camera. */
export function CameraPanel() {
  const { t } = useTranslation('viewer');
  const panel = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const isVisible = useVisible(panel);
  useStream('camera', isVisible, { max_hz: CAMERA_HZ });
  return (
    <div ref={panel} className={classes['panel']} data-testid="viewer-camera">
      <PicturePanel stream="camera" canvas={canvas} label={t('cameraLabel')} emptyText={t('cameraNone')} />
    </div>
  );
}
