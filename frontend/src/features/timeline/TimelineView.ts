import { shownTrace, useShownTrace } from '@/store/moment/shownTrace';
import { useMoment } from '@/store/moment/store';
import { AXIS_PX, drawTimeline, paletteOf } from './draw';
import { spanOf, zoomed, type Span } from './span';

const FIRST_LENGTH_S = 30;
const REDRAW_MS = 100;

/** The visible range of the run, and the canvas that shows it. It is drawn at most ten times a second. */
export class TimelineView {
  /** Called when the view starts or stops following the run. */
  onFollowing: (isFollowing: boolean) => void = () => undefined;
  private canvas: HTMLCanvasElement | null = null;
  private scroller: HTMLElement | null = null;
  private uids: readonly number[] = [];
  /** The end of the visible range; null while the range follows the run. */
  private end: number | null = null;
  private length = FIRST_LENGTH_S;
  private frame = 0;

  /** Draws the rows of a scroller on a canvas; returns a function that stops it. */
  attach(canvas: HTMLCanvasElement, scroller: HTMLElement): () => void {
    this.canvas = canvas;
    this.scroller = scroller;
    this.redraw();
    let drawnAt = -1;
    const timer = setInterval(() => {
      const { now } = shownTrace();
      if (now === drawnAt) return;
      drawnAt = now;
      this.redraw();
    }, REDRAW_MS);
    const resized = new ResizeObserver(this.redraw);
    resized.observe(canvas);
    // The colours depend on the theme, so a change of the theme redraws.
    const themed = new MutationObserver(this.redraw);
    themed.observe(document.documentElement, { attributeFilter: ['data-mantine-color-scheme'] });
    const unfollow = useMoment.subscribe((state, before) => {
      if (state.t === before.t) return;
      this.keepInSight(state.t);
      this.redraw();
    });
    const another = useShownTrace.subscribe(() => {
      this.keepInSight(useMoment.getState().t);
      this.redraw();
    });
    return () => {
      unfollow();
      another();
      clearInterval(timer);
      resized.disconnect();
      themed.disconnect();
      cancelAnimationFrame(this.frame);
      this.frame = 0;
      this.canvas = null;
    };
  }

  setRows(uids: readonly number[]): void {
    this.uids = uids;
    this.redraw();
  }

  span(): Span {
    const { begin, now } = shownTrace();
    return spanOf(this.end, this.length, begin, now);
  }

  readonly redraw = (): void => {
    if (this.frame === 0) this.frame = requestAnimationFrame(() => this.draw());
  };

  /** Zooms about a point, which is given as a share of the width. */
  zoom(factor: number, share = 1): void {
    const { begin, now, lengthS } = shownTrace();
    const longest = Math.min(lengthS, now - begin);
    this.show(zoomed(this.span(), factor, share, longest));
  }

  /** Pans by a share of the width. */
  pan(share: number): void {
    const { from, to } = this.span();
    const by = (to - from) * share;
    this.show({ from: from + by, to: to + by });
  }

  /** Returns a function that restores the current range. */
  remember(): () => void {
    const { end, length } = this;
    return () => {
      this.length = length;
      this.setEnd(end);
    };
  }

  showAll(): void {
    const { begin, now } = shownTrace();
    this.show({ from: begin, to: now });
  }

  follow(): void {
    this.setEnd(null);
  }

  private show({ from, to }: Span): void {
    this.length = to - from;
    const { begin, now } = shownTrace();
    this.setEnd(to >= now ? null : Math.max(to, begin + this.length));
  }

  /** Moves the range to a past moment that is outside of it. */
  private keepInSight(moment: number | null): void {
    if (moment === null) return;
    const { from, to } = this.span();
    const length = to - from;
    if (moment < from || moment > to) this.show({ from: moment - length / 2, to: moment + length / 2 });
  }

  private setEnd(end: number | null): void {
    if ((end === null) !== (this.end === null)) this.onFollowing(end === null);
    this.end = end;
    this.redraw();
  }

  private draw(): void {
    this.frame = 0;
    const { canvas } = this;
    const context = canvas?.getContext('2d');
    if (!canvas || !context) return;
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth: width, clientHeight: height } = canvas;
    if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
    if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawTimeline(shownTrace(), {
      context,
      width,
      height: Math.max(height, AXIS_PX),
      span: this.span(),
      uids: this.uids,
      scrollTop: this.scroller?.scrollTop ?? 0,
      palette: paletteOf(canvas),
      moment: useMoment.getState().t,
    });
  }
}
