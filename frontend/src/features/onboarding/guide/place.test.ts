import { expect, it } from 'vitest';
import { placeBeside } from './place';

const NOTE = { width: 100, height: 50 };
const ROOM = { width: 800, height: 600 };
const at = (left: number, top: number, width: number, height: number, room = ROOM) =>
  placeBeside({ left, top, width, height }, NOTE, room);

it('lies beside its target, where there is room', () => {
  expect(at(0, 200, 200, 100)).toEqual({ left: 214, top: 225, side: 'right' });
  expect(at(600, 200, 200, 100)).toEqual({ left: 486, top: 225, side: 'left' });
  expect(at(0, 0, 800, 100)).toEqual({ left: 350, top: 114, side: 'bottom' });
  expect(at(0, 500, 800, 100)).toEqual({ left: 350, top: 436, side: 'top' });
});

it('lies inside of a target that fills the window', () => {
  expect(at(0, 0, 800, 600)).toEqual({ left: 686, top: 14, side: 'inside' });
});

it('stays in the window', () => {
  expect(at(0, 0, 200, 10).top).toBe(8);
  expect(at(0, 590, 200, 10).top).toBe(542);
  expect(at(20, 0, 60, 580, { width: 120, height: 600 })).toEqual({ left: 8, top: 14, side: 'inside' });
});
