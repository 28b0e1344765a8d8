import type { NodeId } from '@/model/diagram';
import classes from '../Canvas.module.css';

/** Attributes by which elements are found; a picture of an element must not be found for it. */
const NAMES = [
  'id',
  'data-id',
  'data-testid',
  'data-type',
  'data-selected',
  'aria-label',
  'role',
  'tabindex',
];

function pictureOf(element: HTMLElement): HTMLElement {
  const picture = element.cloneNode(true) as HTMLElement;
  for (const each of [picture, ...picture.querySelectorAll('*')]) {
    for (const name of NAMES) each.removeAttribute(name);
  }
  // Else it would move with the block itself.
  picture.classList.remove('react-flow__node', 'dragging', 'selected');
  picture.classList.add(classes['ghostBlock'] ?? '');
  return picture;
}

/**
 * A pale picture of blocks with a plus, which moves with the pointer while they are copied. It is made of the
 * drawn elements, and React does not know it.
 */
export class CopyGhost {
  private readonly element: HTMLElement;

  constructor(
    private readonly canvas: HTMLElement,
    holds: NodeId,
    blocks: readonly HTMLElement[],
  ) {
    this.element = canvas.ownerDocument.createElement('div');
    this.element.className = classes['ghost'] ?? '';
    this.element.dataset['testid'] = 'copy-ghost';
    this.element.setAttribute('aria-hidden', 'true');
    for (const block of blocks) {
      const picture = pictureOf(block);
      if (block.dataset['id'] === holds) picture.append(this.plus());
      this.element.append(picture);
    }
    (canvas.querySelector('.react-flow__viewport') ?? canvas).append(this.element);
    canvas.dataset['copying'] = '';
  }

  moveBy(dx: number, dy: number): void {
    this.element.style.translate = `${dx}px ${dy}px`;
  }

  remove(): void {
    this.element.remove();
    delete this.canvas.dataset['copying'];
  }

  private plus(): HTMLElement {
    const plus = this.canvas.ownerDocument.createElement('span');
    plus.className = classes['ghostPlus'] ?? '';
    plus.textContent = '+';
    return plus;
  }
}
