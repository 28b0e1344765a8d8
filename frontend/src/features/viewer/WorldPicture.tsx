import { Canvas } from '@react-three/fiber';
import { useCallback, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { Scene } from '@/generated/messages';
import { Loading3d } from './pictures/Loading3d';
import type { View } from './offscreen/messages';
import { dprRange, rootOptions } from './offscreen/rootOptions';
import { canDrawInWorker } from './offscreen/support';
import { WorkerCanvas } from './offscreen/WorkerCanvas';
import { pageHost } from './pageHost';
import { Stage } from './scene/Stage';
import './scene/three';
import { isSoftwareWebGl } from './webgl';

interface WorldPictureProps {
  readonly scene: Scene;
  readonly view: View;
  /** Called when the user turns or moves the camera. */
  readonly onTurned: () => void;
  /** Called with the rate of pictures in Hz once it is too low for too long. */
  readonly onSlow: (hz: number) => void;
}

/** The world in 3D, drawn by a worker; in a browser without such workers, by the page. */
export function WorldPicture({ scene, view, onTurned, onSlow }: WorldPictureProps) {
  const { t } = useTranslation('viewer');
  const [hasFailed, setFailed] = useState(false);
  const [isDrawn, setDrawn] = useState(false);
  const onDrawn = useCallback(() => setDrawn(true), []);
  const hint = isDrawn ? null : <Loading3d />;
  const isSimple = isSoftwareWebGl();
  if (canDrawInWorker() && !hasFailed) {
    return (
      <>
        <WorkerCanvas
          view={view}
          label={t('label3d')}
          onTurned={onTurned}
          onSlow={onSlow}
          onDrawn={onDrawn}
          onFailed={() => {
            setFailed(true);
            setDrawn(false);
          }}
        />
        {hint}
      </>
    );
  }
  return (
    <>
      <Canvas
        {...rootOptions(view.isVisible, isSimple)}
        dpr={dprRange(isSimple)}
        aria-label={t('label3d')}
        role="img"
      >
        <Stage
          scene={scene}
          options={view.options}
          isDark={view.isDark}
          isJudged={view.isJudged}
          host={pageHost}
          onMoved={onTurned}
          onSlow={onSlow}
          onDrawn={onDrawn}
        />
      </Canvas>
      {hint}
    </>
  );
}
