import { ActionIcon, NativeSelect, Tooltip } from '@mantine/core';
import { IconPlus } from '@tabler/icons-react';
import { useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useVisible } from '@/ui/hooks/useVisible';
import { useScene } from '../useScene';
import { useStream } from '../useStream';
import classes from '../viewer.module.css';
import { camerasOf, nextCamera, requestedName, shownCamera } from './cameras';
import { PicturePanel } from './PicturePanel';

const CAMERA_HZ = 15;

interface CameraPanelProps {
  /** The camera that the user chose for this view. */
  readonly chosen?: string | null;
  readonly onChoose?: (camera: string) => void;
  /** Opens another view, of the given camera. */
  readonly onAnother?: (camera: string | null) => void;
}

/** The panel with the picture of one of the robots' cameras. */
export function CameraPanel({ chosen = null, onChoose, onAnother }: CameraPanelProps) {
  const { t } = useTranslation('viewer');
  const panel = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const isVisible = useVisible(panel);
  const [wanted, setWanted] = useState(chosen);
  const cameras = camerasOf(useScene());
  const shown = shownCamera(cameras, wanted);
  useStream('camera', isVisible, { max_hz: CAMERA_HZ }, requestedName(cameras, shown));
  return (
    <div ref={panel} className={classes['panel']} data-testid="viewer-camera" data-camera={shown}>
      <PicturePanel
        stream="camera"
        sensor={shown}
        canvas={canvas}
        label={shown === null ? t('cameraLabel') : t('cameraSees', { name: shown })}
        emptyText={t('cameraNone')}
      />
      {shown === null ? null : (
        <div className={classes['choice']}>
          {cameras.length > 1 ? (
            <NativeSelect
              size="xs"
              aria-label={t('cameraChoice')}
              data={cameras}
              value={shown}
              onChange={({ currentTarget: { value } }) => {
                setWanted(value);
                onChoose?.(value);
              }}
            />
          ) : (
            <span className={classes['shown']}>{shown}</span>
          )}
          {onAnother ? (
            <Tooltip label={t('cameraAnother')}>
              <ActionIcon
                variant="default"
                size={30}
                aria-label={t('cameraAnother')}
                onClick={() => onAnother(nextCamera(cameras, shown))}
              >
                <IconPlus size={16} />
              </ActionIcon>
            </Tooltip>
          ) : null}
        </div>
      )}
    </div>
  );
}
