import { createRoot, extend, type ReconcilerRoot } from '@react-three/fiber';
import * as THREE from 'three';
import { frames } from '@/store/session/frames';
import { currentPoses } from '@/store/session/poses';
import { useShownPaths } from '@/store/session/trace/shownPaths';
import { shownTrail } from '@/store/session/trace/shownTrail';
import { trail } from '@/store/session/trace/trail';
import { useMeasuring } from '../measuring';
import { Stage } from '../scene/Stage';
import '../scene/three';
import { isSoftwareWebGl } from '../webgl';
import { dispatch } from './ElementProxy';
import type { FromWorker, Size, ToWorker, View } from './messages';
import { rootOptions } from './rootOptions';
import { WorkerHost } from './WorkerHost';

// <Canvas> does this on the page.
extend(THREE as unknown as Parameters<typeof extend>[0]);

/** The part of a 3D view that runs in a worker: it draws what the page's messages request. */
export class Drawing {
  private readonly host: WorkerHost;
  private root: ReconcilerRoot<OffscreenCanvas> | null = null;
  private size: Size = { width: 1, height: 1, dpr: 1 };
  private view: View | null = null;
  private viewpoint = 0;
  private readonly isSimple = isSoftwareWebGl();

  constructor(
    private readonly post: (message: FromWorker) => void,
    private readonly makeRoot: (canvas: OffscreenCanvas) => ReconcilerRoot<OffscreenCanvas> = createRoot,
  ) {
    this.host = new WorkerHost(post);
    frames.listen('scene', () => this.render());
  }

  receive(message: ToWorker): void {
    switch (message.kind) {
      case 'begin':
        this.root = this.makeRoot(message.canvas);
        return this.resize(message.size);
      case 'view':
        return this.show(message.view, message.viewpoint);
      case 'size':
        this.resize(message.size);
        return this.render();
      case 'frame':
        return frames.publish(message.frame);
      case 'past':
        for (const [id, pose] of message.poses) currentPoses.set(id, pose);
        return trail.restore(message.trail);
      case 'trail':
        return shownTrail.show(message.until, message.points);
      case 'paths':
        return useShownPaths.setState({ paths: message.paths });
      case 'event':
        if (message.to === 'element') return this.host.proxy.receive(message.event);
        return dispatch(this.host.keys, message.event);
      case 'moved':
        return this.host.moved(message.id, message.error);
    }
  }

  private resize(size: Size): void {
    this.size = size;
    this.host.proxy.resize(size);
  }

  private show(view: View, viewpoint: number): void {
    const last = this.viewpoint === viewpoint ? this.view?.options.viewpoint : undefined;
    this.view = last ? { ...view, options: { ...view.options, viewpoint: last } } : view;
    this.viewpoint = viewpoint;
    this.host.mayMove = view.canMove;
    useMeasuring.setState(view.measuring);
    this.render();
  }

  private render(): void {
    const { root, view } = this;
    const scene = frames.scene();
    if (!root || !view || !scene) return;
    const { width, height, dpr } = this.size;
    void root.configure({
      ...rootOptions(view.isVisible, this.isSimple),
      dpr,
      size: { width, height, top: 0, left: 0 },
    });
    root.render(
      <Stage
        scene={scene}
        options={view.options}
        isDark={view.isDark}
        isJudged={view.isJudged}
        host={this.host}
        onMoved={this.turned}
        onSlow={this.slow}
        onDrawn={this.drawn}
      />,
    );
  }

  private readonly turned = (): void => {
    if (this.view?.options.follow) this.post({ kind: 'turned' });
  };

  private readonly drawn = (): void => this.post({ kind: 'drawn' });

  private readonly slow = (hz: number): void => this.post({ kind: 'slow', hz });
}
