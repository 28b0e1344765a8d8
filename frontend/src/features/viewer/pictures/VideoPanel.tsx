import {
  useEffect,
  useRef,
  useState,
  type RefObject,
  type KeyboardEvent,
  type PointerEvent,
  type SyntheticEvent,
} from 'react';
import { Button, Text } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { useTabs } from '@/workspace/tabs';
import { panned, poseOf, START, turned, zoomed, type Orbit } from './orbit';
import { PicturePanel } from './PicturePanel';
import { TeleopPad } from '../TeleopPad';
import { useStream } from '../useStream';
import { useVisible } from '@/ui/hooks/useVisible';
import classes from '../viewer.module.css';
import { hasWebGl } from '../webgl';

const VIDEO_HZ = 30;
/**
 * The widths in px of pictures that may be requested. They are few, since the server renders each width
 * separately.
 */
const WIDTHS = [640, 960, 1280] as const;
const SEND_EVERY_MS = 60;
const KEY_PX = 24;

/**
 * The panel with the world as pictures from the server, for browsers that cannot draw it. A single picture of
 * the world suffices: if 3D is in a window of its own, Video starts only at the user's request.
 */
export function VideoPanel() {
  const { t } = useTranslation('viewer');
  const [isWanted, setWanted] = useState(false);
  const isSpare = useTabs(({ inWindows }) => inWindows.includes('viewer3d') && !inWindows.includes('video'));
  if (!isSpare || isWanted) return <Video />;
  return (
    <div className={classes['panel']} data-testid="viewer-video-spare">
      <div className={classes['empty']}>
        <Text size="sm" c="dimmed">
          {t('videoElsewhere')}
        </Text>
        <Button size="xs" mt="sm" variant="light" onClick={() => setWanted(true)}>
          {t('videoHere')}
        </Button>
      </div>
    </div>
  );
}

/** The video picture; dragging, the wheel and keys turn it. */
export function Video() {
  const { t } = useTranslation('viewer');
  const panel = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const orbit = useRef<Orbit>(START);
  const sending = useRef<ReturnType<typeof setTimeout>>(undefined);
  const isVisible = useVisible(panel);
  const width = usePictureWidth(panel);
  const wanted = { max_hz: VIDEO_HZ, width: WIDTHS[0], camera_pose: poseOf(START) };
  const stream = useStream('view', isVisible, wanted);

  const look = (next: Orbit) => {
    orbit.current = next;
    sending.current ??= setTimeout(() => {
      sending.current = undefined;
      stream.current?.update({ max_hz: VIDEO_HZ, width, camera_pose: poseOf(orbit.current) });
    }, SEND_EVERY_MS);
  };

  // The direction of the camera stays when the width changes or the panel is shown again.
  useEffect(() => {
    stream.current?.update({ max_hz: VIDEO_HZ, width, camera_pose: poseOf(orbit.current) });
  }, [stream, width, isVisible]);

  useEffect(() => {
    const element = panel.current;
    if (!element) return;
    const onWheel = (event: WheelEvent) => {
      event.preventDefault();
      look(zoomed(orbit.current, Math.exp(event.deltaY * 0.001)));
    };
    element.addEventListener('wheel', onWheel, { passive: false });
    return () => {
      element.removeEventListener('wheel', onWheel);
      clearTimeout(sending.current);
      sending.current = undefined;
    };
    // `look` uses only references, so it is not a dependency.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, []);

  /** Returns whether an event is on the picture: elements on top of it handle their own gestures. */
  const isOnPicture = ({ target }: SyntheticEvent) => target === panel.current || target === canvas.current;
  const onPress = (event: PointerEvent) => {
    if (isOnPicture(event)) panel.current?.setPointerCapture(event.pointerId);
  };
  const onDrag = (event: PointerEvent) => {
    if (event.buttons === 0 || !isOnPicture(event)) return;
    const move = event.buttons === 1 && !event.shiftKey ? turned : panned;
    look(move(orbit.current, event.movementX, event.movementY));
  };
  const onKey = (event: KeyboardEvent) => {
    const moves: Record<string, () => Orbit> = {
      ArrowLeft: () => turned(orbit.current, -KEY_PX, 0),
      ArrowRight: () => turned(orbit.current, KEY_PX, 0),
      ArrowUp: () => turned(orbit.current, 0, KEY_PX),
      ArrowDown: () => turned(orbit.current, 0, -KEY_PX),
      '+': () => zoomed(orbit.current, 0.85),
      '-': () => zoomed(orbit.current, 1.18),
    };
    const next = isOnPicture(event) ? moves[event.key]?.() : undefined;
    if (!next) return;
    event.preventDefault();
    look(next);
  };

  return (
    // The role is an application, since dragging and the arrow keys turn the picture.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions
    <div
      ref={panel}
      className={classes['panel']}
      data-testid="viewer-video"
      data-draggable
      // The picture takes the focus, since the arrow keys turn it too.
      // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
      tabIndex={0}
      role="application"
      aria-label={t('videoLabel')}
      onKeyDown={onKey}
      onPointerDown={onPress}
      onPointerMove={onDrag}
      onContextMenu={(event) => event.preventDefault()}
    >
      <PicturePanel
        stream="view"
        canvas={canvas}
        label={t('videoLabel')}
        emptyText={hasWebGl() ? t('videoNone') : `${t('noWebGl')} ${t('press')}`}
      />
      {hasWebGl() ? null : <TeleopPad />}
    </div>
  );
}

/** Returns the smallest width of pictures that fills an element. */
function usePictureWidth(element: RefObject<HTMLElement | null>): number {
  const [width, setWidth] = useState<number>(WIDTHS[0]);
  useEffect(() => {
    if (!element.current) return;
    const observer = new ResizeObserver(([entry]) => {
      const pixels = (entry?.contentRect.width ?? 0) * window.devicePixelRatio;
      setWidth(WIDTHS.find((least) => least >= pixels) ?? WIDTHS[2]);
    });
    observer.observe(element.current);
    return () => observer.disconnect();
  }, [element]);
  return width;
}
