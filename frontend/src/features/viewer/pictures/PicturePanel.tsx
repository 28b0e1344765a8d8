import { Text } from '@mantine/core';
import { useEffect, useState, type ReactNode, type RefObject } from 'react';
import { useTranslation } from 'react-i18next';
import { useMoment } from '@/store/moment/store';
import { hasPicture } from '@/store/moment/world';
import { useSessionStore } from '@/store/session/store';
import { drawPictures, type Shown } from './drawPictures';
import classes from '../viewer.module.css';

interface PicturePanelProps {
  readonly stream: 'camera' | 'view';
  /** The camera whose pictures are drawn; null for those of any camera. */
  readonly sensor?: string | null;
  readonly canvas: RefObject<HTMLCanvasElement | null>;
  readonly label: string;
  readonly emptyText: string;
  readonly children?: ReactNode;
}

/** A panel with pictures from the server, their size and their rate. */
export function PicturePanel({
  stream,
  sensor = null,
  canvas,
  label,
  emptyText,
  children,
}: PicturePanelProps) {
  const { t } = useTranslation('viewer');
  const [shown, setShown] = useState<Shown | null>(null);
  const hasWorld = useSessionStore(
    ({ executor }) => executor !== 'idle' && executor !== 'connected' && executor !== 'universe_ready',
  );
  useEffect(() => {
    if (!canvas.current) return;
    const stop = drawPictures(stream, canvas.current, setShown, sensor);
    return () => {
      stop();
      setShown(null);
    };
  }, [stream, sensor, canvas]);
  const past = useMoment((state) => state.shown);
  const isMissing = past !== null && (stream === 'view' || !hasPicture(past, sensor));
  const isEmpty = (past === null && !hasWorld) || !shown || isMissing;
  return (
    <>
      <canvas ref={canvas} className={classes['image']} hidden={isEmpty} width={640} height={480}>
        {label}
      </canvas>
      {isEmpty ? (
        <Text size="sm" c="dimmed" className={classes['empty']}>
          {isMissing ? t(stream === 'view' ? 'videoIsPresent' : 'noPictureThen') : emptyText}
        </Text>
      ) : (
        <span className={classes['info']} data-testid={`${stream}-figures`}>
          {t('size', { width: shown.width, height: shown.height })}
          {shown.hz > 0 && !past ? ` · ${t('rate', { hz: shown.hz.toFixed(1) })}` : ''}
          {shown.latencyMs === null || past ? '' : ` · ${t('latency', { ms: shown.latencyMs.toFixed(0) })}`}
        </span>
      )}
      {children}
    </>
  );
}
