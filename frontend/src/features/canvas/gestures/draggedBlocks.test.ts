import { beforeEach, expect, it } from 'vitest';
import { BlockDrag, useDraggedBlocks } from './draggedBlocks';

const canvas = document.createElement('div');
const translates = () =>
  Object.fromEntries(
    [...canvas.querySelectorAll<HTMLElement>('[data-id]')].map((element) => [
      `${element.className.slice(12)} ${element.dataset['id']}`,
      element.style.translate,
    ]),
  );

beforeEach(() => {
  canvas.innerHTML = ['top', 'below', 'other']
    .map(
      (id) =>
        `<i class="react-flow__node" data-id="${id}"></i><i class="react-flow__edge" data-id="${id}"></i>`,
    )
    .join('');
});

it('moves the blocks with their subtrees, and the edges between them', () => {
  const hand = new BlockDrag(canvas, 'top', new Set(['top']), new Set(['top', 'below']));
  expect(hand.holds).toBe('top');
  hand.moveBy(3, -4, false);
  expect(translates()).toEqual({
    'node top': '3px -4px',
    'node below': '3px -4px',
    'node other': '',
    // The edge to the top block is drawn again, since its upper end stays in place.
    'edge top': '',
    'edge below': '3px -4px',
    'edge other': '',
  });
  expect(useDraggedBlocks.getState()).toEqual({ tops: new Set(['top']), dx: 3, dy: -4 });
  hand.letGo();
  expect(new Set(Object.values(translates()))).toEqual(new Set(['']));
  expect(useDraggedBlocks.getState()).toEqual({ tops: new Set(), dx: 0, dy: 0 });
});

it('finds blocks that come into view during the drag', () => {
  canvas.querySelectorAll('[data-id=below]').forEach((each) => each.remove());
  const hand = new BlockDrag(canvas, 'top', new Set(['top']), new Set(['top', 'below']));
  hand.moveBy(1, 1, false);
  canvas.insertAdjacentHTML('beforeend', '<i class="react-flow__node" data-id="below"></i>');
  hand.moveBy(2, 2, false);
  expect(translates()['node below']).toBe('2px 2px');
});

it('leaves copied blocks in place, and moves a picture of them', () => {
  const hand = new BlockDrag(canvas, 'top', new Set(['top']), new Set(['top', 'below']));
  hand.moveBy(3, 4, false);
  hand.moveBy(5, 6, true);
  expect(new Set(Object.values(translates()))).toEqual(new Set(['']));
  expect(useDraggedBlocks.getState().tops.size).toBe(0);
  const ghost = canvas.querySelector<HTMLElement>('[data-testid=copy-ghost]')!;
  expect(ghost.style.translate).toBe('5px 6px');
  expect(ghost.children).toHaveLength(2);
  expect(ghost).toHaveTextContent('+');
  expect(ghost.querySelector('[data-id]')).toBeNull();
  hand.copy(false);
  expect(canvas.querySelector('[data-testid=copy-ghost]')).toBeNull();
  expect(translates()['node below']).toBe('5px 6px');
  hand.copy(true);
  hand.letGo();
  expect(canvas.querySelector('[data-testid=copy-ghost]')).toBeNull();
  expect(canvas).not.toHaveAttribute('data-copying');
});
