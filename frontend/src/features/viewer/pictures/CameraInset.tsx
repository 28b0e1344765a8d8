import { useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { useScene } from '../useScene';
import { camerasOf } from './cameras';
import { PicturePanel } from './PicturePanel';
import { useStream } from '../useStream';
import classes from '../viewer.module.css';

const INSET_HZ = 10;
const INSET_WIDTH = 320;

interface CameraInsetProps {
  readonly isVisible: boolean;
}

/** The robot's camera picture in a corner of the 3D view. */
export function CameraInset({ isVisible }: CameraInsetProps) {
  const { t } = useTranslation('viewer');
  const canvas = useRef<HTMLCanvasElement>(null);
  const sensor = camerasOf(useScene())[0] ?? null;
  useStream('camera', isVisible, { max_hz: INSET_HZ, width: INSET_WIDTH });
  return (
    <div className={classes['inset']} data-testid="camera-inset">
      <PicturePanel
        stream="camera"
        sensor={sensor}
        canvas={canvas}
        label={t('cameraLabel')}
        emptyText={t('cameraWaiting')}
      />
    </div>
  );
}
