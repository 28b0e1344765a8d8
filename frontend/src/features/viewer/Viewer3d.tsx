import { Button, Text, useComputedColorScheme } from '@mantine/core';
import { IconCurrentLocation, IconPlayerPlayFilled } from '@tabler/icons-react';
import { useMemo, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { useIsBack } from '@/store/moment/store';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import { CameraInset } from './pictures/CameraInset';
import { keep3d, keeps3d } from './keep3d';
import { canMove } from './lastMove';
import { useMeasuring } from './measuring';
import { Notes } from './Notes';
import type { View } from './offscreen/messages';
import { TeleopPad } from './TeleopPad';
import { usePageShown } from '@/ui/hooks/usePageShown';
import { useScene } from './useScene';
import { useStream } from './useStream';
import { useUsesCamera } from './pictures/useUsesCamera';
import { useVisible } from '@/ui/hooks/useVisible';
import { VideoInstead } from './VideoInstead';
import { ViewerToolbar } from './ViewerToolbar';
import { keepViewOptions, loadViewOptions, type ViewOptions } from './viewOptions';
import classes from './viewer.module.css';
import { hasWebGl } from './webgl';
import { WorldPicture } from './WorldPicture';

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
  const [slowHz, setSlowHz] = useState<number | null>(null);
  const measuring = useMeasuring();
  const canDrag = useSessionStore(canMove);
  // The server draws the present alone: a past moment stays in 3D however slow that is.
  const isBack = useIsBack();
  const isJudged = usePageShown() && isVisible && !isBack && !keeps3d();
  const view = useMemo<View>(
    () => ({ options, isDark, isVisible, isJudged, canMove: canDrag, measuring }),
    [options, isDark, isVisible, isJudged, canDrag, measuring],
  );
  useStream('poses', isVisible && hasWebGl() && slowHz === null, { max_hz: POSES_HZ });
  useStream('scan', isVisible && hasWebGl() && slowHz === null && options.rays, { max_hz: SCAN_HZ });

  const change = (part: Partial<ViewOptions>) => {
    const next = { ...options, ...part };
    setOptions(next);
    keepViewOptions(next);
  };

  if (slowHz !== null && !isBack) {
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
          <WorldPicture
            scene={scene}
            view={view}
            onTurned={() => options.follow && change({ follow: false })}
            onSlow={setSlowHz}
          />
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
  // A tree that is held at a block has its place in `held`.
  const isInPython = useSessionStore((state) => state.executor === 'held' && state.held === null);
  const isWaiting = isLaunching || (executor !== 'idle' && executor !== 'connected');
  const waiting = isInPython ? 'heldInPython' : isWaiting ? 'waiting' : null;
  return (
    <div className={classes['empty']}>
      <Text size="sm" c="dimmed">
        {t(waiting ?? (runBlocker ? `run:runBlocker.${runBlocker}` : 'press'))}
      </Text>
      {waiting || runBlocker ? null : (
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
