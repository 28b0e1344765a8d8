import type { NodeId } from '@/model/diagram';
import classes from '../Canvas.module.css';

/**
 * The attributes by which elements are found; they are removed from a picture, so that nothing finds it
 * instead of the element.
 */
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
  // With these classes the picture would move together with the block.
  picture.classList.remove('react-flow__node', 'dragging', 'selected');
  picture.classList.add(classes['ghostBlock'] ?? '');
  return picture;
}

/**
 * A pale picture of blocks with a plus, which moves with the pointer while the blocks are copied. It is a
 * copy of the drawn elements outside of React.
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
