import {
  type CSSProperties,
  type KeyboardEvent,
  type PointerEvent,
  type ReactNode,
  useEffect,
  useMemo,
  useRef,
  useState,
} from 'react';
import { useTranslation } from 'react-i18next';
import { drawStretch, drawTimes, paletteOf } from '@/features/timeline/draw';
import { leaveMoment } from '@/store/moment/compare/comparing';
import { goSeconds, goTicks, lookAt, setPlaying, type Extent } from '@/store/moment/looking';
import { following, markedRange, panned, useRange, within } from '@/store/moment/range';
import { isPresentRun, useSource } from '@/store/moment/source';
import { lookAtMark } from '@/store/moment/lookAtMark';
import { useMoment } from '@/store/moment/store';
import { editFlag, useFlags } from '@/store/moment/flags';
import type { Mark } from '@/store/recording/types';
import { trace } from '@/store/session/trace/trace';
import classes from './axis.module.css';
import { zoom } from './rangeCommands';
import { MARK_ICONS } from './markIcons';
import { useMarks } from './marks';
import { adviceOf, labelOf } from './markTexts';
import { apart, rootStretches } from './strip';

const MARK_PX = 24;
const WHEEL_STEP = 1.25;
const PAN_STEP = 0.1;

/** The strip of the run, with the root's status as its colour, its marks, and the moment that is shown. */
export function Strip({ extent }: { readonly extent: Extent }) {
  const strip = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const overview = useMoment((state) => (state.overview?.run === extent.run ? state.overview : null));
  // The page's own data are those of the present run.
  const isPresent = useSource(isPresentRun);
  const width = useWidth(strip);
  const a = useRange((state) => state.a);
  const b = useRange((state) => state.b);
  const view = useRange((state) => state.view);
  const { from, to } = view ? within(view, extent) : extent;
  const length = Math.max(to - from, 1e-3);
  const shareOf = (time: number) => Math.min(Math.max((time - from) / length, 0), 1);
  const all = useMarks(extent.run, extent.from);
  const marks = useMemo(() => {
    // A flag of the present may be later than what can be read of the recording.
    const end = to < extent.to ? to : Infinity;
    return apart(
      all.filter(({ t: at }) => at >= from && at <= end),
      (MARK_PX * length) / Math.max(width, 1),
    );
  }, [all, extent.to, from, to, length, width]);
  useZoomByWheel(strip, extent);
  useEffect(() => {
    const follow = () => {
      const { t: moment } = useMoment.getState();
      const { view: now } = useRange.getState();
      if (moment !== null && now) useRange.setState({ view: following(now, extent, moment) });
    };
    follow();
    return useMoment.subscribe((now, before) => {
      if (now.t !== before.t) follow();
    });
  }, [extent]);

  useEffect(() => {
    const draw = () => {
      const element = canvas.current;
      const context = element?.getContext('2d');
      if (!element || !context) return;
      const ratio = window.devicePixelRatio || 1;
      element.width = Math.round(element.clientWidth * ratio);
      element.height = Math.round(element.clientHeight * ratio);
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      const palette = paletteOf(element);
      const root = trace.nodes.find(({ parent }) => parent === 0)?.uid ?? -1;
      const scale = element.clientWidth / length;
      for (const { start, end, mask } of rootStretches(
        overview,
        isPresent ? trace.stretches(root, from, to) : [],
        to,
      )) {
        const x = Math.max((start - from) * scale, 0);
        drawStretch(context, mask, x, Math.max((end - start) * scale, 1), 0, palette);
      }
      drawTimes(context, { from, to: from + length }, element.clientWidth, palette);
    };
    draw();
    // The colours depend on the theme.
    const themed = new MutationObserver(draw);
    themed.observe(document.documentElement, { attributeFilter: ['data-mantine-color-scheme'] });
    return () => themed.disconnect();
  }, [overview, isPresent, from, to, length, width]);

  const range = markedRange({ a, b });
  return (
    <div className={classes['strip']} ref={strip}>
      <canvas ref={canvas} className={classes['canvas']} aria-hidden="true" />
      <Slider extent={extent} from={from} length={length}>
        {range && (
          <span
            className={classes['range']}
            style={{ left: `${shareOf(range.from) * 100}%`, right: `${(1 - shareOf(range.to)) * 100}%` }}
          />
        )}
      </Slider>
      {a !== null && a >= from && a <= to && <EndButton name="A" at={a} share={shareOf(a)} />}
      {b !== null && b >= from && b <= to && <EndButton name="B" at={b} share={shareOf(b)} />}
      {marks.map((mark) => (
        <MarkButton key={`${mark.kind}${mark.id ?? ''}${mark.t}`} mark={mark} share={shareOf(mark.t)} />
      ))}
    </div>
  );
}

interface SliderProps {
  readonly extent: Extent;
  /** The begin and the length of the visible part, in s. */
  readonly from: number;
  readonly length: number;
  readonly children: ReactNode;
}

/** The shown moment as a cursor that is moved by hand or by keys; it alone is rendered at each moment. */
function Slider({ extent, from, length, children }: SliderProps) {
  const { t } = useTranslation('axis');
  const moment = useMoment((state) => state.t);
  const lookThere = ({ currentTarget, clientX }: PointerEvent) => {
    const box = currentTarget.getBoundingClientRect();
    setPlaying(false);
    lookAt(from + ((clientX - box.left) / Math.max(box.width, 1)) * length);
  };
  const onPress = (event: PointerEvent<HTMLDivElement>) => {
    if (event.button !== 0) return;
    event.currentTarget.setPointerCapture?.(event.pointerId);
    lookThere(event);
  };
  const onMove = (event: PointerEvent) => {
    if (event.buttons === 1) lookThere(event);
  };

  const onKeyDown = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const go = (by: 1 | -1) => (event.shiftKey ? goSeconds(by) : void goTicks(by));
    const keys: Record<string, () => void> = {
      ArrowLeft: () => go(-1),
      ArrowRight: () => go(1),
      Home: () => lookAt(extent.from),
      End: () => lookAt(extent.to),
      Escape: leaveMoment,
      ' ': () => setPlaying(!useMoment.getState().isPlaying),
    };
    const doIt = keys[event.key];
    if (!doIt) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.key !== ' ') setPlaying(false);
    doIt();
  };

  const at = moment ?? extent.to;
  return (
    <div
      className={classes['slider']}
      role="slider"
      tabIndex={0}
      data-testid="axis-strip"
      aria-label={t('strip')}
      aria-valuemin={round(extent.from)}
      aria-valuemax={round(extent.to)}
      aria-valuenow={round(at)}
      aria-valuetext={
        moment === null
          ? t('now', { to: extent.to.toFixed(1) })
          : t('at', { t: moment.toFixed(2), to: extent.to.toFixed(1) })
      }
      onPointerDown={onPress}
      onPointerMove={onMove}
      onKeyDown={onKeyDown}
    >
      {children}
      <span
        className={classes['cursor']}
        data-past={moment === null ? undefined : true}
        style={{ left: `${Math.min(Math.max((at - from) / length, 0), 1) * 100}%` }}
      />
    </div>
  );
}

function MarkButton({ mark, share }: { readonly mark: Mark; readonly share: number }) {
  const { t } = useTranslation('axis');
  const Icon = MARK_ICONS[mark.kind];
  const label = labelOf(t, mark);
  const advice = adviceOf(t, mark);
  return (
    <button
      type="button"
      className={classes['mark']}
      data-kind={mark.kind}
      data-testid="axis-mark"
      style={{ '--at': `${share * 100}%` } as CSSProperties}
      title={`${label} ${advice}`.trim()}
      aria-label={`${label} ${advice}`.trim()}
      onClick={() => {
        lookAtMark(mark);
        if (mark.kind === 'stopped') useFlags.setState({ isListed: true });
      }}
      onDoubleClick={() => editFlag(mark)}
    >
      <Icon size={12} aria-hidden="true" />
    </button>
  );
}

/** A marked moment; a click goes there. */
function EndButton({
  name,
  at,
  share,
}: {
  readonly name: 'A' | 'B';
  readonly at: number;
  readonly share: number;
}) {
  const { t } = useTranslation('axis');
  return (
    <button
      type="button"
      className={classes['end']}
      data-testid={`axis-end-${name}`}
      style={{ left: `${share * 100}%` }}
      aria-label={t('end', { name, t: at.toFixed(2) })}
      onClick={() => lookAt(at)}
    >
      {name}
    </button>
  );
}

/** The wheel zooms around the pointer; with Shift, or a sideways wheel, it moves the visible part. */
function useZoomByWheel(ref: { readonly current: HTMLElement | null }, extent: Extent): void {
  useEffect(() => {
    const element = ref.current;
    if (!element) return;
    const onWheel = (event: WheelEvent) => {
      event.preventDefault();
      const { view } = useRange.getState();
      const by = event.shiftKey ? event.deltaY : event.deltaX;
      if (Math.abs(by) > Math.abs(event.shiftKey ? 0 : event.deltaY)) {
        useRange.setState({ view: panned(view, extent, Math.sign(by) * PAN_STEP) });
        return;
      }
      const box = element.getBoundingClientRect();
      const { from, to } = view ?? extent;
      const share = (event.clientX - box.left) / Math.max(box.width, 1);
      zoom(event.deltaY < 0 ? 1 / WHEEL_STEP : WHEEL_STEP, from + share * (to - from));
    };
    // React listens passively, so that the page would scroll as well.
    element.addEventListener('wheel', onWheel, { passive: false });
    return () => element.removeEventListener('wheel', onWheel);
  }, [ref, extent]);
}

const round = (t: number) => Math.round(t * 1000) / 1000;

function useWidth(ref: { readonly current: HTMLElement | null }): number {
  const [width, setWidth] = useState(0);
  useEffect(() => {
    const element = ref.current;
    if (!element) return;
    const observer = new ResizeObserver(() => setWidth(element.clientWidth));
    observer.observe(element);
    return () => observer.disconnect();
  }, [ref]);
  return width;
}
