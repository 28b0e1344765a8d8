import type { Point } from '../measuring';
import type { BodyPose } from '../scene/DraggedBody';
import type { StageHost } from '../scene/host';
import { ElementProxy } from './ElementProxy';
import type { FromWorker } from './messages';

interface Waiting {
  readonly done: () => void;
  readonly refused: (error: Error) => void;
}

/** The host of a stage in a worker: it sends requests to the page as messages. */
export class WorkerHost implements StageHost {
  readonly proxy: ElementProxy;
  readonly keys = new EventTarget();
  mayMove = false;
  private readonly waiting = new Map<number, Waiting>();
  private lastId = 0;

  constructor(private readonly post: (message: FromWorker) => void) {
    this.proxy = new ElementProxy((cursor) => post({ kind: 'cursor', cursor }));
  }

  /** The proxy has all members of an element that the controls and tools use. */
  get element(): HTMLElement {
    return this.proxy as unknown as HTMLElement;
  }

  canMove(): boolean {
    return this.mayMove;
  }

  moveBody(body: string, pose: BodyPose, from: BodyPose): Promise<void> {
    const id = ++this.lastId;
    return new Promise((done, refused) => {
      this.waiting.set(id, { done, refused });
      this.post({ kind: 'move', id, body, pose, from });
    });
  }

  /** Receives the answer of the page to a move. */
  moved(id: number, error: string | null): void {
    const waiting = this.waiting.get(id);
    this.waiting.delete(id);
    if (error === null) waiting?.done();
    else waiting?.refused(new Error(error));
  }

  goTo(t: number): void {
    this.post({ kind: 'goTo', t });
  }

  addMeasured(point: Point): void {
    this.post({ kind: 'measured', point });
  }
}
