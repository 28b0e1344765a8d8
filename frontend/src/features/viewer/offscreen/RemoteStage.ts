import { useMoment } from '@/store/moment/store';
import { shownFrames } from '@/store/session/frames';
import { currentPoses } from '@/store/session/poses';
import { useShownPaths } from '@/store/session/trace/shownPaths';
import { shownTrail } from '@/store/session/trace/shownTrail';
import { trail } from '@/store/session/trace/trail';
import { addMeasured } from '../measuring';
import { pageHost } from '../pageHost';
import { isSoftwareWebGl } from '../webgl';
import type { FromWorker, Size, ToWorker, View } from './messages';
import { dprRange } from './rootOptions';
import { sentEvent } from './sentEvents';

const POINTER_EVENTS = ['pointerdown', 'pointermove', 'pointerup', 'pointercancel', 'contextmenu', 'wheel'];

export interface Reports {
  /** The user has turned or moved the camera. */
  readonly onTurned: () => void;
  readonly onSlow: (hz: number) => void;
  /** The worker has drawn its first picture. */
  readonly onDrawn: () => void;
  /** The worker could not begin or has failed; nothing is drawn any more. */
  readonly onFailed: () => void;
}

const makeWorker = () => new Worker(new URL('./drawingWorker.ts', import.meta.url), { type: 'module' });

/** The page's side of a view that a worker draws: a canvas whose events, size and data go to the worker. */
export class RemoteStage {
  private readonly canvas = document.createElement('canvas');
  private readonly worker: Worker;
  private readonly stops: (() => void)[] = [];
  private shown: View | null = null;
  private viewpoint = 0;

  constructor(
    private readonly parent: HTMLElement,
    view: View,
    private readonly reports: Reports,
    make: () => Worker = makeWorker,
  ) {
    this.canvas.style.cssText = 'display: block; width: 100%; height: 100%; touch-action: none';
    parent.append(this.canvas);
    this.worker = make();
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.receive(data);
    this.worker.onerror = () => reports.onFailed();
    const canvas = this.canvas.transferControlToOffscreen();
    this.post({ kind: 'begin', canvas, size: this.size() }, [canvas]);
    this.show(view);
    this.sendFrames();
    this.sendEvents();
    const observer = new ResizeObserver(() => this.post({ kind: 'size', size: this.size() }));
    observer.observe(parent);
    this.stops.push(() => observer.disconnect());
  }

  show(view: View): void {
    if (this.shown?.options.viewpoint !== view.options.viewpoint) this.viewpoint += 1;
    this.shown = view;
    this.post({ kind: 'view', view, viewpoint: this.viewpoint });
  }

  end(): void {
    for (const stop of this.stops) stop();
    this.worker.terminate();
    this.canvas.remove();
  }

  private post(message: ToWorker, transfer: Transferable[] = []): void {
    this.worker.postMessage(message, transfer);
  }

  private size(): Size {
    const [least, most] = dprRange(isSoftwareWebGl());
    const dpr = Math.min(Math.max(window.devicePixelRatio, least), most);
    return { width: this.parent.clientWidth, height: this.parent.clientHeight, dpr };
  }

  private sendFrames(): void {
    const forward = (frame: Extract<ToWorker, { kind: 'frame' }>['frame']) =>
      this.post({ kind: 'frame', frame });
    this.stops.push(shownFrames.listen('scene', forward));
    // A frame contains only the poses that changed, and a scene only the initial ones, so the current poses
    // are sent too.
    const sendPast = () => this.post({ kind: 'past', poses: [...currentPoses], trail: trail.keep() });
    sendPast();
    // Poses of the past are not part of the present trail.
    this.stops.push(
      useMoment.subscribe((now, before) => {
        if (before.shown && !now.shown) sendPast();
      }),
    );
    const sendTrail = () => this.post({ kind: 'trail', until: shownTrail.until, points: shownTrail.points });
    if (shownTrail.until !== null) sendTrail();
    this.stops.push(shownTrail.subscribe(sendTrail));
    const sendPaths = () => this.post({ kind: 'paths', paths: useShownPaths.getState().paths });
    if (useShownPaths.getState().paths.length > 0) sendPaths();
    this.stops.push(useShownPaths.subscribe(sendPaths));
    this.stops.push(shownFrames.listen('poses', forward), shownFrames.listen('scan', forward));
  }

  private sendEvents(): void {
    const { canvas } = this;
    const onPointer = (event: Event) => {
      // A wheel would scroll the page, and the right button, which moves the view, would open a menu.
      if (event.type === 'wheel' || event.type === 'contextmenu') event.preventDefault();
      if (event.type === 'pointerdown') canvas.setPointerCapture((event as PointerEvent).pointerId);
      this.post({ kind: 'event', to: 'element', event: sentEvent(event, canvas) });
    };
    // Keys turn or cancel the drag of a body; elsewhere they belong to the page.
    const onKey = (event: KeyboardEvent) => {
      if (canvas.style.cursor !== 'grabbing') return;
      if (['Escape', 'q', 'e'].includes(event.key)) event.preventDefault();
      this.post({ kind: 'event', to: 'keys', event: sentEvent(event, canvas) });
    };
    for (const type of POINTER_EVENTS) canvas.addEventListener(type, onPointer, { passive: false });
    window.addEventListener('keydown', onKey);
    this.stops.push(() => window.removeEventListener('keydown', onKey));
  }

  private receive(message: FromWorker): void {
    switch (message.kind) {
      case 'turned':
        return this.reports.onTurned();
      case 'drawn':
        return this.reports.onDrawn();
      case 'slow':
        return this.reports.onSlow(message.hz);
      case 'cursor':
        this.canvas.style.cursor = message.cursor;
        return;
      case 'goTo':
        return pageHost.goTo(message.t);
      case 'measured':
        return addMeasured(message.point);
      case 'move':
        void this.move(message);
    }
  }

  private async move({ id, body, pose, from }: Extract<FromWorker, { kind: 'move' }>): Promise<void> {
    let error: string | null = null;
    await pageHost.moveBody(body, pose, from).catch((reason: Error) => (error = reason.message));
    this.post({ kind: 'moved', id, error });
  }
}
