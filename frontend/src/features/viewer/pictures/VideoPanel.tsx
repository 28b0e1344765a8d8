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
import { useVisible } from '@/ui/useVisible';
import classes from '../viewer.module.css';
import { hasWebGl } from '../webgl';

const VIDEO_HZ = 30;
/** The widths of pictures that may be requested, in px: few, since the server renders each one separately. */
const WIDTHS = [640, 960, 1280] as const;
const SEND_EVERY_MS = 60;
const KEY_PX = 24;

/**
 * The world as pictures that the server draws, for browsers that cannot draw it. One picture of the world is
 * enough: with 3D in a window of its own, Video runs only where the user wants it.
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

/** The picture itself: turned by dragging, the wheel and keys. */
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

  // A new width, or showing the panel again, keeps the camera's direction.
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
    // `look` only uses references.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, []);

  /** Elements on top of the picture handle their own gestures. */
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
    // An application by its role: it is turned by dragging and by the arrow keys.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions
    <div
      ref={panel}
      className={classes['panel']}
      data-testid="viewer-video"
      data-draggable
      // The picture is turned with the arrow keys too, so it takes the focus.
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

/** Returns the smallest width that fills an element. */
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
