import { Button, Text, useComputedColorScheme } from '@mantine/core';
import { IconCurrentLocation, IconPlayerPlayFilled } from '@tabler/icons-react';
import { Canvas } from '@react-three/fiber';
import { useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import { CameraInset } from './pictures/CameraInset';
import { keep3d } from './keep3d';
import { Notes } from './Notes';
import { Stage } from './scene/Stage';
import { TeleopPad } from './TeleopPad';
import './scene/three';
import { useScene } from './useScene';
import { useStream } from './useStream';
import { useUsesCamera } from './pictures/useUsesCamera';
import { useVisible } from '@/ui/useVisible';
import { VideoInstead } from './VideoInstead';
import { ViewerToolbar } from './ViewerToolbar';
import { keepViewOptions, loadViewOptions, type ViewOptions } from './viewOptions';
import classes from './viewer.module.css';
import { hasWebGl, isSoftwareWebGl } from './webgl';

const POSES_HZ = 30;
const SCAN_HZ = 10;

/** The panel with the world in 3D, which the browser draws from the session's poses. */
export function Viewer3d() {
  const { t } = useTranslation('viewer');
  const panel = useRef<HTMLDivElement>(null);
  const isVisible = useVisible(panel);
  const scene = useScene();
  const isDark = useComputedColorScheme('light', { getInitialValueInEffect: false }) === 'dark';
  const [options, setOptions] = useState<ViewOptions>(loadViewOptions);
  const usesCamera = useUsesCamera();
  const camera = options.camera ?? usesCamera;
  const isSimple = isSoftwareWebGl();
  const [slowHz, setSlowHz] = useState<number | null>(null);
  useStream('poses', isVisible && hasWebGl() && slowHz === null, { max_hz: POSES_HZ });
  useStream('scan', isVisible && hasWebGl() && slowHz === null && options.rays, { max_hz: SCAN_HZ });

  const change = (part: Partial<ViewOptions>) => {
    const next = { ...options, ...part };
    setOptions(next);
    keepViewOptions(next);
  };

  if (slowHz !== null) {
    const goBack = () => {
      keep3d();
      setSlowHz(null);
    };
    return <VideoInstead hz={slowHz} onBack={goBack} />;
  }
  return (
    <div
      ref={panel}
      className={classes['panel']}
      data-testid="viewer-3d"
      data-objects={scene?.objects.length ?? 0}
    >
      {!hasWebGl() ? <Text className={classes['empty']}>{t('noWebGl')}</Text> : null}
      {hasWebGl() && !scene ? <NoWorld /> : null}
      {hasWebGl() && scene ? (
        <>
          <Canvas
            frameloop={isVisible ? 'demand' : 'never'}
            shadows={isSimple ? false : 'percentage'}
            dpr={isSimple ? 0.8 : [1, 2]}
            gl={{ antialias: !isSimple, powerPreference: 'high-performance' }}
            camera={{ fov: 45, near: 0.05, far: 200, up: [0, 0, 1], position: [-4, -4, 4] }}
            aria-label={t('label3d')}
            role="img"
          >
            <Stage
              scene={scene}
              options={options}
              isDark={isDark}
              isVisible={isVisible}
              onMoved={() => options.follow && change({ follow: false })}
              onSlow={setSlowHz}
            />
          </Canvas>
          <ViewerToolbar options={{ ...options, camera }} onChange={change} />
          <Notes />
          {options.follow ? null : <FollowButton onClick={() => change({ follow: true })} />}
          <TeleopPad />
          {camera ? <CameraInset isVisible={isVisible} /> : null}
        </>
      ) : null}
    </div>
  );
}

/** The button that returns to following the robot; it appears when the user has moved the camera away. */
function FollowButton({ onClick }: { readonly onClick: () => void }) {
  const { t } = useTranslation('viewer');
  return (
    <Button
      className={classes['follow']}
      size="compact-sm"
      variant="default"
      leftSection={<IconCurrentLocation size={15} aria-hidden="true" />}
      onClick={onClick}
    >
      {t('followShort')}
    </Button>
  );
}

function NoWorld() {
  const { t } = useTranslation(['viewer', 'run']);
  const isLaunching = useSessionStore((state) => state.isLaunching);
  const executor = useSessionStore((state) => state.executor);
  const runBlocker = useRunStore((state) => state.runBlocker);
  const isWaiting = isLaunching || (executor !== 'idle' && executor !== 'connected');
  return (
    <div className={classes['empty']}>
      <Text size="sm" c="dimmed">
        {t(isWaiting ? 'waiting' : runBlocker ? `run:runBlocker.${runBlocker}` : 'press')}
      </Text>
      {isWaiting || runBlocker ? null : (
        <Button
          size="xs"
          mt="sm"
          variant="light"
          leftSection={<IconPlayerPlayFilled size={14} />}
          onClick={() => perform('run.run')}
        >
          {t('run')}
        </Button>
      )}
    </div>
  );
}
