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

it('moves the blocks with what hangs below them, and the edges between them', () => {
  const hand = new BlockDrag(canvas, 'top', new Set(['top']), new Set(['top', 'below']));
  expect(hand.holds).toBe('top');
  hand.moveBy(3, -4);
  expect(translates()).toEqual({
    'node top': '3px -4px',
    'node below': '3px -4px',
    'node other': '',
    // The edge to the top is drawn again, since its upper end stays.
    'edge top': '',
    'edge below': '3px -4px',
    'edge other': '',
  });
  expect(useDraggedBlocks.getState()).toEqual({ tops: new Set(['top']), dx: 3, dy: -4 });
  hand.letGo();
  expect(new Set(Object.values(translates()))).toEqual(new Set(['']));
  expect(useDraggedBlocks.getState()).toEqual({ tops: new Set(), dx: 0, dy: 0 });
});

it('finds blocks that come into view on the way', () => {
  canvas.querySelectorAll('[data-id=below]').forEach((each) => each.remove());
  const hand = new BlockDrag(canvas, 'top', new Set(['top']), new Set(['top', 'below']));
  hand.moveBy(1, 1);
  canvas.insertAdjacentHTML('beforeend', '<i class="react-flow__node" data-id="below"></i>');
  hand.moveBy(2, 2);
  expect(translates()['node below']).toBe('2px 2px');
});
