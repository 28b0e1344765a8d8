import { create } from 'zustand';
import type { NodeId } from '@/model/diagram';

/** The offset of dragged blocks from their places in the layout; edges to `tops` are drawn again. */
interface DraggedBlocks {
  readonly tops: ReadonlySet<NodeId>;
  readonly dx: number;
  readonly dy: number;
}

export const useDraggedBlocks = create<DraggedBlocks>(() => ({ tops: new Set(), dx: 0, dy: 0 }));

/**
 * Moves dragged blocks with the pointer. It sets the CSS property `translate`, which React does not set, on
 * the drawn elements: no block renders, however many move and however large the tree is. Each step queries
 * the page again and so includes blocks that come into view.
 */
export class BlockDrag {
  constructor(
    private readonly canvas: HTMLElement,
    readonly holds: NodeId,
    readonly tops: ReadonlySet<NodeId>,
    private readonly ids: ReadonlySet<NodeId>,
  ) {}

  moveBy(dx: number, dy: number): void {
    this.translate(`${dx}px ${dy}px`);
    useDraggedBlocks.setState({ tops: this.tops, dx, dy });
  }

  letGo(): void {
    this.translate('');
    useDraggedBlocks.setState({ tops: new Set(), dx: 0, dy: 0 });
  }

  private translate(by: string): void {
    for (const element of this.canvas.querySelectorAll<HTMLElement>('.react-flow__node')) {
      if (this.ids.has(element.dataset['id'] ?? '')) element.style.translate = by;
    }
    for (const element of this.canvas.querySelectorAll<SVGElement>('.react-flow__edge')) {
      const child = element.dataset['id'] ?? '';
      if (this.ids.has(child) && !this.tops.has(child)) element.style.translate = by;
    }
  }
}
